// A triangle whose corners move linearly, and whether it surely stays upright.
#pragma once

#include <array>
#include <glm/common.hpp>
#include <limits>

#include "core/types.h"

namespace kinemesh {

// At (1 - s) x0 + s x1 for s from 0 to 1.
struct MovingFace {
  std::array<Point, 3> x0, x1;
};

// A side at share s = 0 or `until`, and a bound of what was summed up for it.
struct RoundedSide {
  Point value, magnitude;
};

inline RoundedSide side_at(const MovingFace& f, int corner, double s) {
  const Point e0 = f.x0[corner] - f.x0[0], e1 = f.x1[corner] - f.x1[0];
  const Point start = (1.0 - s) * e0, end = s * e1;
  return {start + end, glm::abs(start) + glm::abs(end)};
}

// Whether u x v + v' x u' exceeds its rounding error. Each side is within 4u + O(u^2) of its magnitude, a
// product within 9u, the sum of two crosses within 11u of the sum of magnitudes: 16u has room for rounding the
// bound. What underflows is off by 2^-1074, times the other factor's magnitude. Overflow fails the comparison.
inline bool is_surely_positive(const RoundedSide& u, const RoundedSide& v, const RoundedSide& w,
                               const RoundedSide& z) {
  const double value =
      u.value.x * v.value.y - u.value.y * v.value.x + w.value.x * z.value.y - w.value.y * z.value.x;
  const double magnitude = u.magnitude.x * v.magnitude.y + u.magnitude.y * v.magnitude.x +
                           w.magnitude.x * z.magnitude.y + w.magnitude.y * z.magnitude.x;
  const Point all = u.magnitude + v.magnitude + w.magnitude + z.magnitude;
  return value > 16.0 * 0x1p-53 * magnitude + std::numeric_limits<double>::min() * (1.0 + all.x + all.y);
}

// True only if the face is upright throughout [0, until].
//
// A quadratic whose three Bernstein coefficients over [0, until] are positive has no root there; they are
// u0 x v0, (u0 x v1 + u1 x v0) / 2 and u1 x v1.
inline bool is_surely_upright(const MovingFace& f, double until) {
  const RoundedSide u0 = side_at(f, 1, 0.0), v0 = side_at(f, 2, 0.0);
  const RoundedSide u1 = side_at(f, 1, until), v1 = side_at(f, 2, until);
  return is_surely_positive(u0, v0, u0, v0) && is_surely_positive(u0, v1, u1, v0) &&
         is_surely_positive(u1, v1, u1, v1);
}

}  // namespace kinemesh
