// A user's program whose mesh is OpenMesh's: a square of two faces, there and back.
#include <kinemesh/openmesh.h>

using OpenMesh2 = OpenMesh::TriMesh_ArrayKernelT<>;

int main() {
  const kinemesh::MeshData square{.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                                  .triangles = {{0, 1, 2}, {0, 2, 3}}};
  const auto open = kinemesh::to_openmesh<OpenMesh2>(kinemesh::build_mesh(square));
  return open.n_edges() == 5 && kinemesh::from_openmesh(open).triangles == square.triangles ? 0 : 1;
}
