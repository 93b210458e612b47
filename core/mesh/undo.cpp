#include "core/mesh/undo.h"

#include <algorithm>

namespace kinemesh {

Undo::Undo(Mesh& mesh)
    : mesh_(mesh),
      one_{.faces = {0},
           .triangles = {{}},
           .labels = {0},
           .halfedges = {{}},
           .edges = {0, 0, 0},
           .constraints = {0, 0, 0},
           .outgoing = {3, Edge{}}} {}

void Undo::splice(const Patch& patch) {
  for (const int face : patch.faces) note(face);
  mesh_.splice(patch);
}

void Undo::flip(int edge) {
  note(mesh_.face_of(2 * edge));
  note(mesh_.face_of(2 * edge + 1));
  mesh_.flip(edge);
}

void Undo::note(int face) {
  Face old{face, mesh_.label(face), mesh_.triangles()[face], mesh_.sides(face), {}, {}};
  for (int k = 0; k < 3; ++k) {
    old.constraints[k] = mesh_.constraint_of(Mesh::edge_of(old.sides[k]));
    old.outgoing[k] = mesh_.outgoing(old.corners[k]);
  }
  old_.push_back(old);
}

std::vector<int> Undo::rewritten_faces() const {
  std::vector<int> faces;
  for (const auto& old : old_) faces.push_back(old.face);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

// What a change rewrites is noted before it, all its corners with it, so that what is written last, the oldest,
// is what was there at first.
void Undo::take_back() noexcept {
  for (auto old = old_.rbegin(); old != old_.rend(); ++old) {
    one_.faces[0] = old->face;
    one_.triangles[0] = old->corners;
    one_.labels[0] = old->label;
    one_.halfedges[0] = old->sides;
    for (int k = 0; k < 3; ++k) {
      one_.edges[k] = Mesh::edge_of(old->sides[k]);
      one_.constraints[k] = old->constraints[k];
      one_.outgoing[k] = {old->corners[k], old->outgoing[k]};
    }
    mesh_.splice(one_);
  }
  old_.clear();
}

}  // namespace kinemesh
