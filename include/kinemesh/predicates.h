// Exact signs of a few polynomials in the coordinates: the only geometry that decides topology.
//
// Each predicate evaluates in doubles under a static error bound and falls back to exact arithmetic where the
// bound does not tell the sign; the answer is that of real arithmetic for all finite doubles. Laws, tested:
//   orientation(a,b,c) == orientation(b,c,a) == -orientation(b,a,c);  in_circle likewise under even/odd
//   permutations.
// Pre everywhere: finite coordinates, rounding to nearest.
#pragma once

#include <array>
#include <cmath>

#include "kinemesh/detail/orientation_filter.h"
#include "kinemesh/types.h"

#pragma GCC visibility push(default)
namespace kinemesh {

enum class Orientation : signed char { Clockwise = -1, Collinear = 0, CounterClockwise = 1 };
enum class InCircle : signed char { Outside = -1, On = 0, Inside = 1 };

constexpr Orientation operator-(Orientation o) {
  return static_cast<Orientation>(-static_cast<int>(o));
}

// Out of line: exact, always right, slow (core/exact/exact.cpp).
Orientation orientation_exact(const Point& a, const Point& b, const Point& c);
InCircle in_circle_exact(const Point& a, const Point& b, const Point& c, const Point& d);

// Which way a -> b -> c turns.
inline Orientation orientation(const Point& a, const Point& b, const Point& c) {
  const double l = (a.x - c.x) * (b.y - c.y);
  const double r = (a.y - c.y) * (b.x - c.x);
  const double det = l - r;
  if (std::abs(det) > orientation_bound(std::abs(l), std::abs(r))) {
    return det > 0.0 ? Orientation::CounterClockwise : Orientation::Clockwise;
  }
  return orientation_exact(a, b, c);
}

// Where d lies with respect to the circle through the counter-clockwise triangle a, b, c. Through a clockwise
// one inside and outside are exchanged; through three points of a line the circle is a half-plane, as the
// determinant has it.
InCircle in_circle(const Point& a, const Point& b, const Point& c, const Point& d);

// Contact of closed sets. `shared` bits tell apart "same vertex" (bit set: the two ends are one mesh vertex
// and meeting there is no contact) from "same place" (bit clear).

// A segment's end points with the numbers of the mesh vertices that sit there.
struct Segment {
  Point a, b;
  int va, vb;
};

// True if the closed segments meet anywhere but at a vertex they share. Another end at that vertex's place is
// a contact (two vertices at one place); an edge does not touch itself (two shared vertices).
bool segments_touch(const Segment& s, const Segment& t);

// True if the interiors cross in one point that is interior to both.
bool segments_cross(const Point& a, const Point& b, const Point& c, const Point& d);

// True if point p lies on the closed segment a, b.
bool on_segment(const Point& p, const Point& a, const Point& b);

struct NumberedTriangle {
  std::array<Point, 3> p;
  std::array<int, 3> v;
};

// p strictly inside the triangle, whatever its orientation; never inside a flat one.
bool strictly_inside(const Point& p, const std::array<Point, 3>& triangle);

// True if the segment meets the triangle's interior, or touches one of its sides anywhere but at a vertex
// shared with that side: a shared corner that lies on the opposite side of a flat triangle is a contact. A
// segment that is a side of the triangle does not touch it in this sense, whatever the triangle's shape.
bool touches(const Segment& s, const NumberedTriangle& triangle);

// True if the interiors of the two triangles have a common point. Flat triangles have no interior.
bool interiors_overlap(const std::array<Point, 3>& s, const std::array<Point, 3>& t);

// True if a side of one, not a side of the other, touches the other as above: for proper triangles, if they
// have a common point other than shared vertices and the shared edge. A triangle does not touch itself.
bool touches(const NumberedTriangle& s, const NumberedTriangle& t);

}  // namespace kinemesh
#pragma GCC visibility pop
