// Small meshes for the tests of motion.
#pragma once

#include <functional>

#include "kinemesh/build.h"

namespace kinemesh::test {

// [0,1]^2 in n x n squares cut along a diagonal; markers bottom, right, top, left. Vertex (i, j) is j (n + 1)
// + i.
MeshData grid(int n);

// The vertex of the mesh that the user's grid(n) calls (i, j).
inline Vertex grid_vertex(const Mesh& mesh, int n, int i, int j) {
  return mesh.vertex_of_user(UserVertex(j * (n + 1) + i));
}

// Every point mapped.
MeshData mapped(MeshData data, const std::function<Point(Point)>& map);

}  // namespace kinemesh::test
