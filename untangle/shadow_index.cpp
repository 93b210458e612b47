#include "untangle/shadow_index.h"

namespace kinemesh {

ShadowIndex::ShadowIndex(const Mesh& mesh, std::span<const int> faces) {
  std::vector<Entry> entries;
  entries.reserve(faces.size());
  for (const int f : faces) {
    entries.emplace_back(box_of(mesh.corners(f)), f);
  }
  tree_ = decltype(tree_)(entries);  // packed
}

}  // namespace kinemesh
