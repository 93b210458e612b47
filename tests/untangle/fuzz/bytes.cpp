#include "tests/untangle/fuzz/bytes.h"

#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh::test {

MeshData lattice_cells(Bytes& bytes) {
  Random diagonals(bytes.below(16));
  auto data = random_grid(1 + bytes.below(4), 1 + bytes.below(4), diagonals);
  std::vector<Triangle> kept;
  for (std::size_t cell = 0; cell < data.triangles.size(); cell += 2) {
    const int choice = bytes.below(8);  // 0 to 2: no label, 7: missing
    if (choice == 7) continue;
    for (const std::size_t face : {cell, cell + 1}) {
      kept.push_back(data.triangles[face]);
      data.labels.push_back(choice / 3);
    }
  }
  data.triangles = kept;
  return data;
}

void move_on_lattice(Mesh& mesh, Bytes& bytes) {
  for (UserVertex user(0); user < mesh.n_user_vertices() && !bytes.empty(); ++user) {
    const Vertex v = mesh.vertex_of_user(user);
    const int jump = bytes.below(64);
    if (jump < 49 && !mesh.is_isolated(v)) mesh.positions()[v] += Point(jump % 7 - 3, jump / 7 - 3);
  }
}

}  // namespace kinemesh::test
