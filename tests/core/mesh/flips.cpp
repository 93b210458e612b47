#include "tests/core/mesh/flips.h"

namespace kinemesh::test {

Patch flip_of(const Mesh& mesh, Side side) {
  const Side h = mesh.lower(side), o = mesh.opposite(h);
  const Face left = Mesh::face_of(h), right = Mesh::face_of(o);
  const Vertex a = mesh.from(h), b = mesh.to(h), c = mesh.apex(h), d = mesh.apex(o);
  Patch patch;
  patch.faces = {left, right};
  patch.triangles = {{d, b, c}, {c, a, d}};
  patch.labels = {mesh.label(left), mesh.label(right)};
  const std::array<std::array<Side, 2>, 2> border{
      {{Mesh::prev(o), Mesh::next(h)}, {Mesh::prev(h), Mesh::next(o)}}};
  for (int i = 0; i < 2; ++i) {
    patch.across.push_back({~border[i][0], ~border[i][1], Mesh::side(Face(1 - i), 2)});
    for (int k = 0; k < 2; ++k)
      if (const int c_there = mesh.constraint_of(border[i][k]); c_there != none)
        patch.lines.push_back({Mesh::side(Face(i), k), c_there});
  }
  return patch;
}

bool can_flip(const Mesh& mesh, Side side) {
  const Side o = mesh.opposite(side);
  if (o == none || mesh.constraint_of(side) != none) return false;
  const Vertex c = mesh.apex(side), d = mesh.apex(o);
  for (const Face f : mesh.faces())
    for (const Side s : Mesh::sides(f))
      if ((mesh.from(s) == c && mesh.to(s) == d) || (mesh.from(s) == d && mesh.to(s) == c)) return false;
  return c != d;
}

}  // namespace kinemesh::test
