// Exact tests whether open convex sets have a common point, for the exploration of overlapping sheets.
//
// All are signs of polynomials in the coordinates of up to nine points: a static filter first, rational
// arithmetic where it does not tell. Pre everywhere: finite coordinates; triangles not flat, of either
// orientation.
#pragma once

#include <array>
#include <span>

#include "kinemesh/types.h"

namespace kinemesh {

using Shadow = std::array<Point, 3>;  // a face's image in the plane

// True if the interiors of all three triangles have a common point.
bool interiors_overlap(const Shadow& s, const Shadow& t, const Shadow& u);

// True if every point of the first triangle is in the second, border included.
bool is_within(const Shadow& t, const Shadow& container);

// True if the interiors of all triangles have a common point. By Helly's theorem any three at a time decide.
bool interiors_overlap(std::span<const Shadow> triangles);

// True if a point between a and b lies in the interior of every one of the triangles; with none, if a != b.
bool meets_interior(const Point& a, const Point& b, std::span<const Shadow> triangles);

// Sum of the orientations (+1 upright, -1 inverted) of those `sheets` whose interior holds a point that lies
// in the interior of `piece` and on no side of any sheet. Where the sum depends on the point it is that of
// some point.
int signed_cover(const Shadow& piece, std::span<const Shadow> sheets);

}  // namespace kinemesh
