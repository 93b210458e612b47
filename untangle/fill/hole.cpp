#include "untangle/fill/hole.h"

namespace kinemesh {

void Hole::dig(const Mesh& mesh, const FaceSets& sets, int set) {
  faces = sets.faces(set);
  border.clear();
  inner_constraints.clear();
  for (const Face face : faces) {
    for (const Side side : Mesh::sides(face)) {
      const Face across = mesh.face_across(side);
      if (across == none || sets.set_of(across) != set)
        border.push_back({side, mesh.from(side), mesh.to(side)});
      else if (face < across && mesh.has_constraint(side))
        inner_constraints.push_back(side);
    }
  }
}

}  // namespace kinemesh
