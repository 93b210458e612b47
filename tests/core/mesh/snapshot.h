// Everything a mesh holds that a repair may change, to compare bit for bit.
#pragma once

#include <array>
#include <vector>

#include "kinemesh/mesh.h"

namespace kinemesh::test {

struct FaceSnapshot {
  MeshTriangle corners;
  Sides opposite;
  std::array<int, 3> constraints;  // per side
  int label;
  UserFace user_face;
  bool operator==(const FaceSnapshot&) const = default;
};

struct Snapshot {
  std::vector<FaceSnapshot> faces;
  std::vector<Side> fans;  // per vertex: where its fan starts, or none
  std::vector<double> coordinates;
  bool operator==(const Snapshot&) const = default;
};

Snapshot snapshot_of(const Mesh& mesh);

}  // namespace kinemesh::test
