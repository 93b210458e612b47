// A solver's time loop around kinemesh: docs/embedding.md goes through it piece by piece.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

#include "kinemesh/build.h"
#include "kinemesh/cell_transfer.h"
#include "kinemesh/field.h"
#include "kinemesh/motion.h"
#include "kinemesh/shapes.h"
#include "kinemesh/stepper.h"
#include "kinemesh/validate.h"

namespace {

// A blob of medium that turns faster in the middle.
kinemesh::Point swirl(const kinemesh::Point& x) {
  const kinemesh::Point arm = x - kinemesh::Point(0.5, 0.5);
  const double speed = 40 * std::max(0.0, 0.2 - arm.x * arm.x - arm.y * arm.y);
  return speed * kinemesh::Point(-arm.y, arm.x);
}

class Swirl : public kinemesh::VelocityField {
 public:
  std::string_view name() const override { return "swirl of mine"; }
  kinemesh::Point velocity(const kinemesh::Point& x, double) const override { return swirl(x); }
};

// Stands for yours: what it keeps about the mesh, by vertex and by face.
struct Solver {
  std::vector<kinemesh::Point> x;
  std::vector<kinemesh::Triangle> triangles;
  std::vector<double> temperature;  // of vertices
  std::vector<double> mass;         // of faces
  std::vector<kinemesh::FaceChange> changed;

  explicit Solver(const kinemesh::MeshData& mesh)
      : x(mesh.points), triangles(mesh.triangles), temperature(x.size(), 1.0), mass(triangles.size(), 1.0) {}

  void move(double dt) {
    for (auto& p : x) p += dt * swirl(p);
  }
  void update_matrix(const std::vector<kinemesh::FaceChange>& faces) {
    for (const auto& change : faces) {
      triangles[change.face] = kinemesh::numbers_of(change.after);
    }
  }
};

}  // namespace

int main() {
  kinemesh::MeshData mesh = kinemesh::make_square(2000);  // or your own arrays
  kinemesh::Stepper stepper(kinemesh::build_mesh(mesh, {.frame = 0.25}), {.quality = "delaunay"});
  const kinemesh::Motion motion(stepper.mesh(), {{std::make_shared<Swirl>(), {}}});

  Solver solver(mesh);
  stepper.observe([&](const kinemesh::StepChanges& changes) {
    const auto mass = kinemesh::remap_amounts(changes, solver.mass);
    solver.changed.clear();
    for (const auto& patch : changes.patches)
      solver.changed.insert(solver.changed.end(), patch.faces.begin(), patch.faces.end());
    mass.apply(solver.mass);
  });

  const double dt = 0.05;
  for (int n = 0; n < 40; ++n) {
    solver.move(dt);
    const auto outcome = stepper.step(solver.x, dt);
    if (!outcome) {
      std::puts(outcome.message().c_str());  // the mesh is as it was before the step
      return 1;
    }
    solver.update_matrix(solver.changed);
  }

  const std::span<kinemesh::Point> x = stepper.positions();  // in your order
  for (auto& p : x) p += dt * swirl(p);
  if (!stepper.repair(dt)) return 1;  // and x is as it was
  solver.update_matrix(solver.changed);

  if (!stepper.step(motion, dt)) return 1;
  solver.update_matrix(solver.changed);

  const double mass = std::accumulate(solver.mass.begin(), solver.mass.end(), 0.0);
  const bool is_same = solver.triangles == stepper.mesh().domain().triangles;
  std::printf("%d steps, mass off by %.1e of %d, faces %s\n", stepper.steps_done(), mass - mesh.n_faces(),
              mesh.n_faces(), is_same ? "followed" : "lost");
  return kinemesh::validate(stepper.mesh()) || std::abs(mass - mesh.n_faces()) > 1e-9 * mesh.n_faces();
}
