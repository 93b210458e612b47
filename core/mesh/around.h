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

// Calls visit(h) for each half-edge h that leaves the vertex, counter-clockwise while its faces are upright.
template <class Visit>
void for_each_outgoing(const Mesh& mesh, int vertex, const Visit& visit) {
  if (mesh.is_isolated(vertex)) return;
  const int first = mesh.outgoing(vertex);
  int h = first;
  do {
    visit(h);
    h = Mesh::opposite(mesh.prev(h));
  } while (h != first);
}

}  // namespace kinemesh
