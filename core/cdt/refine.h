// Delaunay refinement under a size field; CGAL's Mesh_2 stays behind it, in one source file.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "kinemesh/types.h"

namespace kinemesh {

using SizeField = std::function<double(const Point&)>;  // longest edge wanted at a place

struct Refinement {
  std::vector<Point> points;        // the input's, then new ones along a Hilbert curve
  std::vector<Triangle> triangles;  // of the domain, counter-clockwise
};

// Triangulates what `edges` enclose, without the hole around `in_hole`, with new points until no edge is
// longer than the size at its triangle's centre and no angle below 20.7 degrees, except at sharper corners of
// the input. Edges are split where needed. Pre: the edges are closed, disjoint polygons over all points.
// Deterministic. 20 us per resulting point.
Refinement refine(std::span<const Point> points, std::span<const Edge> edges, const Point& in_hole,
                  const SizeField& size);

}  // namespace kinemesh
