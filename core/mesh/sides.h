// Sides of bare triangles, before there is a mesh: side 3f + k runs from corner k of triangle f to
// corner k + 1.
#pragma once

#include <span>
#include <vector>

#include "kinemesh/mesh.h"

namespace kinemesh {

struct SidePairs {
  std::vector<int> opposite;  // per side: the side of another triangle that runs the other way, or none
  int conflict = none;  // a triangle with a side that a third triangle has, or that another runs the same way
};

// Whether two sides that run the same way are a pair, too.
enum class Winding { Consistent, Any };

// Pairs sides by their end points. Pre: 0 <= corners < n_vertices. O(n).
SidePairs pair_sides(std::span<const Triangle> triangles, int n_vertices,
                     Winding winding = Winding::Consistent);

// The mesh's side that is side 3f + k of these, or none; and a mesh's corners from theirs.
inline Side side_of_pair(int side) {
  return side == none ? Side(none) : Mesh::side(Face(side / 3), side % 3);
}

inline MeshTriangle mesh_triangle(const Triangle& t) {
  return {Vertex(t[0]), Vertex(t[1]), Vertex(t[2])};
}

inline Edge ends_of_side(std::span<const Triangle> triangles, int side) {
  const auto& t = triangles[side / 3];
  return {t[side % 3], t[(side + 1) % 3]};
}

}  // namespace kinemesh
