#include "untangle/fill/remeshable_set.h"

#include <algorithm>

namespace kinemesh {

RemeshableSet::RemeshableSet(const Mesh& mesh, const FaceSets& sets, int set, std::span<const Cell> cells)
    : mesh_(mesh), sets_(sets), set_(set) {
  number_vertices();
  for (const auto& [face, inverted] : cells) over_[inverted].push_back(face);
  for (auto& [inverted, faces] : over_) std::sort(faces.begin(), faces.end());
}

void RemeshableSet::number_vertices() {
  for (const Face face : faces()) {
    const auto& t = mesh_.triangles()[face];
    vertices_.insert(vertices_.end(), t.begin(), t.end());
  }
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
}

int RemeshableSet::number(Vertex vertex) const {
  return static_cast<int>(std::lower_bound(vertices_.begin(), vertices_.end(), vertex) - vertices_.begin());
}

Triangle RemeshableSet::corners(Face face) const {
  const auto& [a, b, c] = mesh_.triangles()[face];
  return {number(a), number(b), number(c)};
}

}  // namespace kinemesh
