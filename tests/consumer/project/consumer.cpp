// A user's program: a mesh from arrays, one step that inverts a face, and the record of its repair.
#include <kinemesh/build.h>
#include <kinemesh/stepper.h>
#include <kinemesh/validate.h>

#include <cstdio>
#include <vector>

namespace {

// A triangle 4 5 6 inside a square.
kinemesh::MeshData triangle_in_square() {
  kinemesh::MeshData data;
  data.points = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 1}, {1.5, 2}};
  data.triangles = {{4, 5, 6}, {0, 1, 5}, {0, 5, 4}, {1, 2, 5}, {2, 6, 5}, {2, 3, 6}, {3, 0, 4}, {3, 4, 6}};
  return data;
}

void print(const kinemesh::StepRecord& record, int faces_before) {
  const auto& repair = record.repair;
  std::printf("step %d to time %g: %d inverted face, %zu region of %d faces, %d faces %s\n", record.step,
              record.time, repair.inverted, repair.regions.size(), repair.region_faces(), record.faces,
              record.faces == faces_before ? "before and after" : "after");
}

}  // namespace

int main() {
  const auto data = triangle_in_square();
  kinemesh::Stepper stepper(kinemesh::build_mesh(data));
  auto x = data.points;
  x[6] = {1.5, 0.5};  // through the edge 4 5
  const auto outcome = stepper.step(x, 0.1);
  if (!outcome) {
    std::printf("%s\n", outcome.message().c_str());
    return 1;
  }
  print(outcome.record, data.n_faces());
  return kinemesh::validate(stepper.mesh()) ? 1 : 0;
}
