#include "motion/fields/compose.h"

#include <glm/geometric.hpp>

namespace kinemesh {

Point SumField::velocity(const Point& x, double t) const {
  Point sum(0.0, 0.0);
  for (const auto& part : parts_) sum += part->velocity(x, t);
  return sum;
}

Point DiscField::velocity(const Point& x, double t) const {
  const Point r = x - center_;
  return glm::dot(r, r) <= radius_ * radius_ ? field_->velocity(x, t) : Point(0.0, 0.0);
}

}  // namespace kinemesh
