// The edges of a mesh, each by the lower of its sides.
#pragma once

#include <vector>

#include "kinemesh/mesh.h"

namespace kinemesh::test {

inline std::vector<Side> all_edges(const Mesh& mesh) {
  std::vector<Side> edges;
  for (const Face face : mesh.faces())
    for (const Side side : Mesh::sides(face))
      if (mesh.is_lower(side)) edges.push_back(side);
  return edges;
}

// The lower side of a random side's edge.
template <class Random>
Side random_edge(const Mesh& mesh, Random& random) {
  return mesh.lower(Mesh::side(Face(random.below(mesh.n_faces())), random.below(3)));
}

}  // namespace kinemesh::test
