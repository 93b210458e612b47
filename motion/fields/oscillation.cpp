#include "motion/fields/oscillation.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "motion/fields/rigid.h"

namespace kinemesh {

Point Pitch::displacement(const Point& initial, double t) const {
  return turned_minus_self(initial - center_, amplitude_ * std::sin(omega_ * t));
}

Pose Pitch::pose(double t) const {
  return {.angle = amplitude_ * std::sin(static_cast<long double>(omega_) * t)};
}

Plunge::Plunge(const Point& direction, double amplitude, double omega)
    : reach_(amplitude / std::hypot(direction.x, direction.y) * direction), omega_(omega) {}

Point Plunge::displacement(const Point&, double t) const {
  return std::sin(omega_ * t) * reach_;
}

Pose Plunge::pose(double t) const {
  const long double way = std::sin(static_cast<long double>(omega_) * t);
  return {.x = way * reach_.x, .y = way * reach_.y};
}

}  // namespace kinemesh
