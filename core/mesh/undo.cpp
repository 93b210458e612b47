#include "core/mesh/undo.h"

#include <algorithm>

namespace kinemesh {

void Undo::splice(Patch& patch) {
  for (const Face face : patch.faces) note(face);
  mesh_.splice(patch);
}

void Undo::flip(Side side) {
  note(Mesh::face_of(side));
  note(mesh_.face_across(side));
  mesh_.flip(side);
}

void Undo::note(Face face) {
  old_.push_back(mesh_.save(face));
}

std::vector<Face> Undo::rewritten_faces() const {
  std::vector<Face> faces;
  for (const auto& old : old_) faces.push_back(old.face);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

void Undo::take_back() noexcept {
  mesh_.restore(old_);
  old_.clear();
}

}  // namespace kinemesh
