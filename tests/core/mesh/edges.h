// The edges of a mesh, each by the lower of its sides.
#pragma once

#include <vector>

#include "kinemesh/mesh.h"

namespace kinemesh::test {

inline std::vector<int> all_edges(const Mesh& mesh) {
  std::vector<int> edges;
  for (int face = 0; face < mesh.n_faces(); ++face)
    for (const int side : Mesh::sides(face))
      if (mesh.is_lower(side)) edges.push_back(side);
  return edges;
}

// The lower side of a random side's edge.
template <class Random>
int random_edge(const Mesh& mesh, Random& random) {
  return mesh.lower(Mesh::side(random.below(mesh.n_faces()), random.below(3)));
}

}  // namespace kinemesh::test
