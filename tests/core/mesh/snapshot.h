// Everything a mesh holds that a repair may change, to compare bit for bit.
#pragma once

#include <vector>

#include "kinemesh/mesh.h"

namespace kinemesh::test {

struct FaceState {
  Triangle corners, sides;
  int label, user_face;
  bool operator==(const FaceState&) const = default;
};

struct HalfedgeState {
  int to, next, face, constraint;
  bool operator==(const HalfedgeState&) const = default;
};

struct Snapshot {
  std::vector<FaceState> faces;
  std::vector<HalfedgeState> halfedges;
  std::vector<int> outgoing;
  std::vector<double> coordinates;
  bool operator==(const Snapshot&) const = default;
};

Snapshot snapshot_of(const Mesh& mesh);

}  // namespace kinemesh::test
