// The few types everything else is written in.
#pragma once

#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>

namespace kinemesh {

using Point = glm::dvec2;             // user's length unit
using Triangle = std::array<int, 3>;  // vertex numbers, counter-clockwise when upright
using Edge = std::array<int, 2>;      // vertex numbers

// Label of the faces that embed the domain in a convex set [Agarwal 2008, §1, boundary assumption]; never
// exported. Every other int32 is a user's label.
inline constexpr int padding_label = std::numeric_limits<int>::min();

inline constexpr int none = -1;  // "no such vertex, face, edge or marker"

inline double dot(const Point& a, const Point& b) {
  return a.x * b.x + a.y * b.y;
}

inline double cross(const Point& a, const Point& b) {  // twice the signed area of 0, a, b
  return a.x * b.y - a.y * b.x;
}

inline bool is_finite(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

}  // namespace kinemesh
