// Parts and border loops of a plain list of triangles. No embedding is needed, so tangled meshes will do.
#pragma once

#include <span>
#include <vector>

#include "kinemesh/types.h"

namespace kinemesh {

// Both take `opposite` as pair_sides (core/mesh/sides.h) gives it: side 3 f + k runs from corner k of face f
// to the next.

// Classes under "shares an edge with" of the faces that are `in`; one flag per face.
int count_parts(std::span<const int> opposite, const std::vector<bool>& in);

// Closed walks along the border with the faces on the left. Where parts of the border meet in one vertex, a
// walk goes on along the faces it came by, so two faces that share but a vertex have two loops.
int count_border_loops(std::span<const int> opposite);

// Which of `edges` no triangle has, ascending. O(n log m) for n triangles and m edges.
std::vector<int> missing_edges(std::span<const Triangle> triangles, std::span<const Edge> edges);

}  // namespace kinemesh
