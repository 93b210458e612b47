// New faces for some of a mesh's, ready to take their place: Mesh::splice.
#pragma once

#include <vector>

#include "kinemesh/mesh.h"

namespace kinemesh {

struct Patch {
  // What becomes of a constraint's edge.
  struct Line {
    Side side;       // 4 i + k: side k of triangle i
    int constraint;  // its number
  };

  std::vector<Face> faces;              // the faces to rewrite
  std::vector<MeshTriangle> triangles;  // as many; triangle i is written to faces[i]
  std::vector<int> labels;              // one per triangle
  // Beyond side k of triangle i: side 4 j + m of triangle j, or ~s where it lies where side s of one of the
  // faces to rewrite lies on their border.
  std::vector<Triangle> across;
  std::vector<Line> lines;  // the constrained edges, each once, those of the border too
};

}  // namespace kinemesh
