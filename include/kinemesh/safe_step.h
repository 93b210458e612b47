// How much of a step can be done before the first triangle is flat.
#pragma once

#include <optional>
#include <span>

#include "kinemesh/types.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// Vertices move linearly, x(s) = (1 - s) x0 + s x1 for s from 0 to 1.
struct SafeStep {
  double share;  // every face is upright for all s in [0, share)
  int face;      // the smallest of those that are flat first
};

// The first time at which any face is flat, the exact root of its quadratic signed area rounded down to a
// double; 0 if one is not upright at the start; nothing if all are upright throughout [0, 1]. Exact: doubles
// under an error bound tell which faces cannot be first, and the others are decided in rational numbers. In
// parallel; the result does not depend on the number of threads. Cost O(n), a few microseconds for each face
// that is almost flat before or at the first root.
//
// Whoever steps with velocities v over dt asks for x1 = x0 + dt v; share dt is then the longest safe step.
// Throws InputError for a vertex number out of range or a position that is not finite.
std::optional<SafeStep> max_safe_step(std::span<const Triangle> faces, std::span<const Point> x0,
                                      std::span<const Point> x1);

}  // namespace kinemesh
#pragma GCC visibility pop
