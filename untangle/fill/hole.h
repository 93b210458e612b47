// What is there to fill where faces are taken out of a mesh.
#pragma once

#include <vector>

#include "kinemesh/mesh.h"
#include "untangle/walk/face_sets.h"

namespace kinemesh {

struct Hole {
  // An edge of its border, as the side of one of the faces; beyond it is another face, or none.
  struct BorderSide {
    Side side;
    Vertex from, to;
  };

  std::vector<Face> faces;         // that are taken out, ascending
  std::vector<BorderSide> border;  // in the order of the faces, from corner 0 of each on
  // Of the edges between two of the faces those that are constrained, by their lower sides; in the order of
  // the faces.
  std::vector<Side> inner_constraints;

  // Takes out the faces of a set, ascending. Reads no other face. Keeps its memory from one to the next.
  void dig(const Mesh& mesh, const FaceSets& sets, int set);

  int size() const { return static_cast<int>(faces.size()); }
};

}  // namespace kinemesh
