#include <cstdio>

#include "kinemesh/build.h"
#include "kinemesh/stepper.h"

int main() {
  kinemesh::MeshData data;  // a triangle 4 5 6 inside a square 0 1 2 3
  data.points = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 1}, {1.5, 2}};
  data.triangles = {{4, 5, 6}, {0, 1, 5}, {0, 5, 4}, {1, 2, 5}, {2, 6, 5}, {2, 3, 6}, {3, 0, 4}, {3, 4, 6}};
  kinemesh::Stepper stepper(kinemesh::build_mesh(data));

  auto positions = data.points;
  positions[6] = {1.5, 0.5};  // vertex 6 goes straight through the edge 4 5
  const auto outcome = stepper.step(positions, 0.1);
  if (!outcome) return std::puts(outcome.message().c_str()), 1;  // and the mesh is as it was
  std::printf("%d inverted, %d replaced:\n", outcome.record.repair.inverted, outcome.record.repair.replaced);
  for (const auto& [a, b, c] : stepper.mesh().domain().triangles) std::printf("%d %d %d\n", a, b, c);
}
