// Exact signs of a few polynomials in the coordinates: the only geometry that decides topology.
//
// Each predicate evaluates in doubles under a static error bound and falls back to exact arithmetic where the bound does
// not tell the sign; the answer is that of real arithmetic for all finite doubles. Laws, tested:
//   orientation(a,b,c) == orientation(b,c,a) == -orientation(b,a,c);  in_circle likewise under even/odd permutations.
// Pre everywhere: finite coordinates.
#pragma once

#include <array>
#include <cmath>

#include "core/types.h"

namespace kinemesh {

enum class Orientation : signed char { Clockwise = -1, Collinear = 0, CounterClockwise = 1 };
enum class Side : signed char { Outside = -1, On = 0, Inside = 1 };

constexpr Orientation operator-(Orientation o) { return static_cast<Orientation>(-static_cast<int>(o)); }

// Out of line: exact, always right, slow (core/exact.cpp).
Orientation orientation_exact(const Point& a, const Point& b, const Point& c);

// Which way a -> b -> c turns.
Orientation orientation(const Point& a, const Point& b, const Point& c);

// Where d lies with respect to the circle through the counter-clockwise triangle a, b, c.
Side in_circle(const Point& a, const Point& b, const Point& c, const Point& d);

// Contact of closed sets. `shared` bits tell apart "same vertex" (bit set: the two ends are one mesh vertex and meeting
// there is no contact) from "same place" (bit clear).

// A segment's end points with the numbers of the mesh vertices that sit there.
struct Segment {
  Point a, b;
  int va, vb;
};

// True if the closed segments have a common point other than the position of a vertex they share.
bool segments_touch(const Segment& s, const Segment& t);

// True if the interiors cross in one point that is interior to both.
bool segments_cross(const Point& a, const Point& b, const Point& c, const Point& d);

// True if point p lies on the closed segment a, b.
bool on_segment(const Point& p, const Point& a, const Point& b);

struct Corners {
  std::array<Point, 3> p;
  std::array<int, 3> v;
};

// p strictly inside the triangle, whatever its orientation; never inside a flat one.
bool strictly_inside(const Point& p, const std::array<Point, 3>& triangle);

// True if the closed segment has a common point with the closed triangle other than the position of shared vertices. A
// segment that is a side of the triangle does not touch it in this sense.
bool touches(const Segment& s, const Corners& triangle);

// True if the interiors of the two triangles have a common point. Flat triangles have no interior.
bool interiors_overlap(const std::array<Point, 3>& s, const std::array<Point, 3>& t);

// True if the closed triangles have a common point other than the positions of shared vertices and the shared edge.
bool touches(const Corners& s, const Corners& t);

}  // namespace kinemesh
