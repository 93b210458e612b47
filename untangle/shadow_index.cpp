#include "untangle/shadow_index.h"

#include <algorithm>

namespace kinemesh {

ShadowIndex::ShadowIndex(const Mesh& mesh, std::span<const int> faces) {
  std::vector<Entry> entries;
  entries.reserve(faces.size());
  for (const int f : faces) {
    const auto [a, b, c] = mesh.corners(f);
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [bottom, top] = std::minmax({a.y, b.y, c.y});
    entries.emplace_back(Box{{left, bottom}, {right, top}}, f);
  }
  tree_ = decltype(tree_)(entries);  // packed
}

}  // namespace kinemesh
