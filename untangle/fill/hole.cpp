#include "untangle/fill/hole.h"

#include "core/base/sort_distinct.h"

namespace kinemesh {

void Hole::dig(const Mesh& mesh, const FaceSets& sets, int set) {
  faces = sets.faces(set);
  border.clear();
  inner.clear();
  inner_constraints.clear();
  for (const int face : faces) {
    const auto& corners = mesh.triangles()[face];
    const auto sides = mesh.sides(face);
    for (int k = 0; k < 3; ++k) {
      const int across = mesh.face_of(Mesh::opposite(sides[k])), edge = Mesh::edge_of(sides[k]);
      if (across == none || sets.set_of(across) != set) {
        border.push_back({sides[k], corners[k], corners[k == 2 ? 0 : k + 1]});
      } else if (face < across) {
        inner.push_back(edge);
        if (mesh.constraint_of(edge) != none) inner_constraints.push_back(sides[k]);
      }
    }
  }
  sort_distinct(inner, mesh.n_edges());
}

}  // namespace kinemesh
