// What surrounds a vertex or lies beside an edge, as moving and flipping ask for it.
#pragma once

#include "kinemesh/mesh.h"
#include "kinemesh/predicates.h"

namespace kinemesh {

inline bool is_upright(const Mesh& mesh, int face) {
  const auto [a, b, c] = mesh.corners(face);
  return orientation(a, b, c) == Orientation::CounterClockwise;
}

// A vertex that may be placed anew: the user's, not fixed, on no constrained edge.
inline bool is_movable(const Mesh& mesh, int v) {
  return mesh.user_vertex(v) != none && !mesh.is_isolated(v) && !mesh.is_constrained(v) && !mesh.is_fixed(v);
}

// The half-edge of an edge along the lower of its two faces.
inline int lower_side(const Mesh& mesh, int edge) {
  const int left = mesh.face_of(2 * edge), right = mesh.face_of(2 * edge + 1);
  return left != none && (right == none || left < right) ? 2 * edge : 2 * edge + 1;
}

// Sides by number: 4 f + k is that of face f from corner k to corner k + 1.
inline int halfedge_at(const Mesh& mesh, int side) {
  return mesh.sides(side >> 2)[side & 3];
}
inline int side_along(const Mesh& mesh, int halfedge) {
  const auto sides = mesh.sides(mesh.face_of(halfedge));
  return 4 * mesh.face_of(halfedge) + (sides[0] == halfedge ? 0 : sides[1] == halfedge ? 1 : 2);
}

// The half-edge that leaves a vertex along the lowest of its faces; on the hull, along the hull. Where a fan starts does
// not depend on what was replaced before. Pre: not isolated.
inline int start_of_fan(const Mesh& mesh, int vertex) {
  const int first = mesh.outgoing(vertex);
  int start = first;
  for (int h = Mesh::opposite(mesh.prev(first)); h != first; h = Mesh::opposite(mesh.prev(h)))
    if (mesh.face_of(h) < mesh.face_of(start)) start = h;  // none is below all faces
  return start;
}

// Calls visit(h) for each half-edge h that leaves the vertex, counter-clockwise while its faces are upright, from
// start_of_fan on.
template <class Visit>
void for_each_outgoing(const Mesh& mesh, int vertex, const Visit& visit) {
  if (mesh.is_isolated(vertex)) return;
  const int first = start_of_fan(mesh, vertex);
  int h = first;
  do {
    visit(h);
    h = Mesh::opposite(mesh.prev(h));
  } while (h != first);
}

}  // namespace kinemesh
