// Where a vertex has to be for the smallest angle around it to be as large as it can.
#pragma once

#include <array>
#include <span>

#include "kinemesh/types.h"

namespace kinemesh {

using LinkEdge = std::array<Point, 2>;  // the side of a face that lies opposite to the vertex

// The largest angle a vertex at x can promise: the smallest of the triangles (x, p, q), in radians; 0 if one
// of them is not upright. The triangles with a bound on it form a convex set, so that a local maximum is a
// global one [Amenta 1999]. Rounded.
double smallest_angle(std::span<const LinkEdge> link, const Point& x);

// Steepest ascent from `start` for the smallest angle, which is smooth but where angles are equal: the
// direction is the shortest vector in the convex hull of the gradients of those within a hair of the
// smallest, the step goes to where, seen linearly, another angle becomes the smallest, and is halved while it
// gains too little [Freitag 1995]. Returns a place with an angle no smaller than at `start`. Pre: all
// triangles upright there. Rounded; stops short of the maximum where gains become negligible.
Point optimal_point(std::span<const LinkEdge> link, const Point& start);

}  // namespace kinemesh
