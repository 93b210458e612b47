#include "tests/core/mesh/flips.h"

namespace kinemesh::test {

Patch flip_of(const Mesh& mesh, int h) {
  const int o = Mesh::opposite(h), left = mesh.face_of(h), right = mesh.face_of(o);
  const int a = mesh.from(h), b = mesh.to(h), c = mesh.apex(h), d = mesh.apex(o);
  Patch patch;
  patch.faces = {left, right};
  patch.triangles = {{d, b, c}, {c, a, d}};
  patch.labels = {mesh.label(left), mesh.label(right)};
  patch.halfedges = {{mesh.prev(o), mesh.next(h), h}, {mesh.prev(h), mesh.next(o), o}};
  patch.edges = {Mesh::edge_of(h)};
  patch.constraints = {none};
  return patch;
}

bool can_flip(const Mesh& mesh, int h) {
  const int o = Mesh::opposite(h);
  if (mesh.face_of(h) == none || mesh.face_of(o) == none || mesh.constraint_of(h) != none) return false;
  const int c = mesh.apex(h), d = mesh.apex(o);
  for (int g = 0; g < 2 * mesh.n_edges(); ++g) {
    if (mesh.from(g) == c && mesh.to(g) == d) return false;
  }
  return c != d;
}

}  // namespace kinemesh::test
