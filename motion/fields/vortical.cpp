#include "motion/fields/vortical.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace kinemesh {
namespace {

using std::numbers::pi;

// sin(pi x) and cos(pi x), exactly 0 where they vanish: a vertex on the box's border stays on it.
double sin_pi(double x) {
  double r = x - 2.0 * std::round(0.5 * x);
  if (std::abs(r) > 0.5) r = std::copysign(1.0, r) - r;
  return std::sin(pi * r);
}
double cos_pi(double x) {
  return std::sin(pi * (0.5 - std::abs(x - 2.0 * std::round(0.5 * x))));
}

double square(double x) {
  return x * x;
}

bool inside_unit(const Point& x) {
  return x.x >= 0.0 && x.x <= 1.0 && x.y >= 0.0 && x.y <= 1.0;
}

}  // namespace

Point Swirl::velocity(const Point& x, double t) const {
  const Point p = box_.to_unit(x);
  if (!inside_unit(p)) return {0.0, 0.0};
  const double u = -square(sin_pi(p.x)) * sin_pi(2.0 * p.y);
  const double v = square(sin_pi(p.y)) * sin_pi(2.0 * p.x);
  return box_.to_user(cos_pi(t / period_) * Point(u, v));
}

Point TaylorGreen::velocity(const Point& x, double) const {
  const Point p = box_.to_unit(x);
  return box_.to_user({sin_pi(p.x) * cos_pi(p.y), -cos_pi(p.x) * sin_pi(p.y)});
}

Point Gresho::velocity(const Point& x, double) const {
  const Point r = box_.to_unit(x) - 0.5;
  const double radius = glm::length(r);
  if (radius >= 0.4) return {0.0, 0.0};
  const double rate = radius <= 0.2 ? 5.0 : 2.0 / radius - 5.0;  // speed / radius
  return box_.to_user({-rate * r.y, rate * r.x});
}

Point Twist::velocity(const Point& x, double t) const {
  const Point p = 2.0 * box_.to_unit(x) - 1.0;
  const Point gap = 1.0 - p * p;
  if (gap.x <= 0.0 || gap.y <= 0.0) return {0.0, 0.0};
  const double rate = rate_ * square(gap.x * gap.y) * cos_pi(t / period_);
  return box_.to_user(0.5 * rate * Point(-p.y, p.x));
}

Point PointVortices::velocity(const Point& x, double) const {
  Point sum(0.0, 0.0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point r = x - points_[i];
    sum += strengths_[i] / (glm::dot(r, r) + core_ * core_) * Point(-r.y, r.x);
  }
  return sum / (2.0 * pi);
}

}  // namespace kinemesh
