#include "untangle/walk/shadow_index.h"

namespace kinemesh {

void ShadowIndex::build(const Mesh& mesh, std::span<const Face> faces) {
  faces_.assign(faces.begin(), faces.end());
  boxes_.clear();
  for (const Face face : faces) boxes_.push_back(box_of(mesh.corners(face)));
  tree_.build(boxes_);
}

}  // namespace kinemesh
