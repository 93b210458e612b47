// The tests' truth for kinemesh/predicates.h: signs in exact integers, contacts of closed sets by clipping in
// exact fractions. Brute force, independent of the code under test.
#pragma once

#include <array>
#include <boost/rational.hpp>
#include <vector>

#include "kinemesh/predicates.h"

namespace kinemesh::oracle {

// Signs of the determinants, for all finite doubles: coordinates are integers in units of 2^-1074.
Orientation orientation(const Point& a, const Point& b, const Point& c);
InCircle in_circle(const Point& a, const Point& b, const Point& c, const Point& d);

// Contacts of points with small integer coordinates (up to about 1000).
struct Fraction2 {
  boost::rational<long long> x, y;
  bool operator==(const Fraction2&) const = default;
};
using Hull = std::vector<Fraction2>;  // convex, in cyclic order; 1 or 2 points are degenerate hulls

Hull hull(const Point& a, const Point& b);
Hull hull(const std::array<Point, 3>& t);
Hull intersection(const Hull& a, const Hull& b);  // may repeat points

bool segments_touch(const Segment& s, const Segment& t);
bool segments_cross(const Point& a, const Point& b, const Point& c, const Point& d);
bool touches(const Segment& s, const NumberedTriangle& t);
bool touches(const NumberedTriangle& s, const NumberedTriangle& t);
bool interiors_overlap(const std::array<Point, 3>& s, const std::array<Point, 3>& t);

}  // namespace kinemesh::oracle
