#include "motion/fields/rigid.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace kinemesh {

Point Rotation::velocity(const Point& x, double) const {
  const Point r = x - center_;
  return {-rate_ * r.y, rate_ * r.x};
}

ZalesakRotation::ZalesakRotation(double period) : Rotation({0.5, 0.5}, 2.0 * std::numbers::pi / period) {}

Point Translation::velocity(const Point&, double) const {
  return velocity_;
}

Point Shear::velocity(const Point& x, double) const {
  return {rate_ * (x.y - center_.y), 0.0};
}

Point Rotor::displacement(const Point& initial, double t) const {
  const Point r = initial - center_;
  if (glm::dot(r, r) > radius_ * radius_) return {0.0, 0.0};
  return turned_minus_self(r, rate_ * t);
}

Point turned_minus_self(const Point& r, double angle) {
  const double half = std::sin(0.5 * angle);
  const double c = -2.0 * half * half;
  const double s = std::sin(angle);
  return {c * r.x - s * r.y, s * r.x + c * r.y};
}

}  // namespace kinemesh
