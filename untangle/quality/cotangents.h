// A cheap proof that an edge is locally Delaunay.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "kinemesh/types.h"

namespace kinemesh {
namespace cotangents {

// Dot and cross products below are right within 12 u size, u = 2^-53: those of u and v within 3 u size, as no
// underflow is near, and a difference of two within 8 u size.
inline constexpr double product_error = 16.0 * 0x1p-53;
inline constexpr double least_size = 0x1p-900;

// With t = error / cross < 1/2, dot - error over anything within error of cross is no less than q (1 -+ 2 t),
// q = (dot - error) / cross. What is taken off besides is more than a float can round up.
inline float bound(double dot, double error, double per_cross) {
  const double q = (dot - error) * per_cross;
  return static_cast<float>(q - std::abs(q) * (2.0 * error * per_cross + 0x1p-22) - 0x1p-100);
}

}  // namespace cotangents

// No more than the cotangents of the angles opposite the sides of an upright triangle: number k is that
// across from the side from corner k to corner k + 1; minus infinity where rounding leaves too little to say.
// An edge is locally Delaunay if the two angles across from it add up to two right ones at most, so if their
// cotangents add up to 0 or more: where two of these bounds do, it is proved.
inline std::array<float, 3> cotangent_bounds(const std::array<Point, 3>& p) {
  const Point u = p[0] - p[2], v = p[1] - p[2];
  const double uu = u.x * u.x + u.y * u.y, uv = u.x * v.x + u.y * v.y, vv = v.x * v.x + v.y * v.y;
  const double cross = u.x * v.y - u.y * v.x, size = uu + vv, error = cotangents::product_error * size;
  if (!(cross > 2.0 * error && size > cotangents::least_size)) {
    constexpr float nothing = -std::numeric_limits<float>::infinity();
    return {nothing, nothing, nothing};
  }
  const double per_cross = 1.0 / cross;
  const auto bound = [&](double dot) { return cotangents::bound(dot, error, per_cross); };
  return {bound(uv), bound(uu - uv), bound(vv - uv)};
}

}  // namespace kinemesh
