// Convex polygons in fractions: the tests' truth for core/exact/overlap.h.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <set>
#include <span>
#include <vector>

#include "core/exact/overlap.h"

namespace kinemesh::test {

using Fraction = boost::multiprecision::cpp_rational;

struct ExactPoint {
  Fraction x, y;
};
using ExactPolygon = std::vector<ExactPoint>;  // convex, counter-clockwise; may repeat points

ExactPolygon exact(const Shadow& triangle);  // turned over if it is inverted
Fraction area(const ExactPolygon& polygon);  // twice
// The part to the left of a -> b, border included.
ExactPolygon clipped(const ExactPolygon& polygon, const ExactPoint& a, const ExactPoint& b);

// By clipping: the common part has an area.
bool have_common_interior(std::span<const Shadow> triangles);

// By the open intervals in which a segment lies left of each side.
bool runs_through(const Point& a, const Point& b, std::span<const Shadow> triangles);

// The sums of the orientations of the sheets over all cells into which their sides cut the piece.
std::set<int> covers(const Shadow& piece, std::span<const Shadow> sheets);

}  // namespace kinemesh::test
