// The plane cut up by the shadows of all edges of a mesh, as plain arrays: what the oracle's combinatorics
// stand on. Exact; CGAL stays in the one source file.
#pragma once

#include <array>
#include <vector>

#include "kinemesh/mesh.h"

namespace kinemesh::test {

struct Subdivision {
  // Between two neighbouring vertices of the subdivision, from the lexicographically smaller to the larger.
  struct Segment {
    int left, right;          // cells
    std::array<int, 2> ends;  // vertices of the subdivision
    std::vector<Side> edges;  // the mesh's edges over it, ascending; exactly one in general position
  };

  int n_cells = 0;
  int n_vertices = 0;
  std::vector<Segment> segments;
  std::vector<int> place_of;  // per vertex of the mesh: vertex of the subdivision; none if isolated
};

Subdivision subdivide(const Mesh& mesh);

}  // namespace kinemesh::test
