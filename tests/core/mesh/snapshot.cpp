#include "tests/core/mesh/snapshot.h"

#include "core/mesh/around.h"

namespace kinemesh::test {

Snapshot snapshot_of(const Mesh& mesh) {
  Snapshot snapshot;
  for (const Face f : mesh.faces()) {
    FaceSnapshot face{mesh.triangles()[f], {}, {}, mesh.label(f), mesh.user_face(f)};
    for (int k = 0; k < 3; ++k) {
      face.opposite[k] = mesh.opposite(Mesh::side(f, k));
      face.constraints[k] = mesh.constraint_of(Mesh::side(f, k));
    }
    snapshot.faces.push_back(face);
  }
  for (const Vertex v : mesh.vertices()) {
    snapshot.fans.push_back(mesh.is_isolated(v) ? none : start_of_fan(mesh, v));
    snapshot.coordinates.insert(snapshot.coordinates.end(), {mesh.position(v).x, mesh.position(v).y});
  }
  return snapshot;
}

}  // namespace kinemesh::test
