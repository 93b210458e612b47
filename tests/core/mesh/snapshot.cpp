#include "tests/core/mesh/snapshot.h"

namespace kinemesh::test {

Snapshot snapshot_of(const Mesh& mesh) {
  Snapshot snapshot;
  for (int f = 0; f < mesh.n_faces(); ++f) {
    snapshot.faces.push_back({mesh.triangles()[f], mesh.sides(f), mesh.label(f), mesh.user_face(f)});
  }
  for (int h = 0; h < 2 * mesh.n_edges(); ++h) {
    snapshot.halfedges.push_back({mesh.to(h), mesh.next(h), mesh.face_of(h), mesh.constraint_of(h)});
  }
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    snapshot.outgoing.push_back(mesh.outgoing(v));
    snapshot.coordinates.insert(snapshot.coordinates.end(), {mesh.position(v).x, mesh.position(v).y});
  }
  return snapshot;
}

}  // namespace kinemesh::test
