// Everything a mesh holds that a repair may change, to compare bit for bit.
#pragma once

#include <vector>

#include "kinemesh/mesh.h"

namespace kinemesh::test {

struct FaceSnapshot {
  Triangle corners, opposite, constraints;  // per side the two latter
  int label, user_face;
  bool operator==(const FaceSnapshot&) const = default;
};

struct Snapshot {
  std::vector<FaceSnapshot> faces;
  std::vector<int> fans;  // per vertex: where its fan starts, or none
  std::vector<double> coordinates;
  bool operator==(const Snapshot&) const = default;
};

Snapshot snapshot_of(const Mesh& mesh);

}  // namespace kinemesh::test
