// A pendulum in a channel: its bob is the cylinder, its pivot on the top wall. The loop integrates the
// equation of motion and tells the mesh where the bob is; the period is held against the exact one.
//
//   example_pendulum [OUT.su2]    the mesh where the bob has last turned back
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <vector>

#include "kinemesh/build.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/shapes.h"
#include "kinemesh/stepper.h"

namespace {

constexpr double g = 9.81, length = 0.5, dt = 0.01, highest = std::numbers::pi / 3.0;
constexpr kinemesh::Point pivot{1.0, 1.0};

struct Pendulum {
  double angle, speed;  // radians, counter-clockwise; radians per time

  void advance() {  // leapfrog
    angle += 0.5 * dt * speed;
    speed -= dt * g / length * std::sin(angle);
    angle += 0.5 * dt * speed;
  }
  kinemesh::Point place(const kinemesh::Point& at_rest) const {
    const kinemesh::Point arm = at_rest - pivot;
    const double c = std::cos(angle), s = std::sin(angle);
    return pivot + kinemesh::Point(c * arm.x - s * arm.y, s * arm.x + c * arm.y);
  }
};

std::vector<kinemesh::UserVertex> bob_of(const kinemesh::MeshData& mesh) {
  std::vector<kinemesh::UserVertex> vertices;
  for (const auto& marker : mesh.markers)
    if (marker.name == "cylinder")
      for (const auto& edge : marker.edges)  // a closed curve: each begins one
        vertices.push_back(kinemesh::UserVertex(edge[0]));
  return vertices;
}

}  // namespace

int main(int argc, char** argv) {
  const kinemesh::MeshData mesh = kinemesh::make_channel(2000);
  kinemesh::Stepper stepper(kinemesh::build_mesh(mesh), {.quality = "angles", .angle = 22.0});
  const std::vector<kinemesh::UserVertex> bob = bob_of(mesh);
  std::vector<kinemesh::Point> to(bob.size());

  const double sine = std::sin(highest / 2.0);
  Pendulum pendulum{0.0, 2.0 * std::sqrt(g / length) * sine};  // as fast as takes it to the highest angle
  double smallest = 60.0, last = 0.0;
  int periods = 0;
  while (stepper.steps_done() < 800) {
    const Pendulum before = pendulum;
    pendulum.advance();
    for (std::size_t i = 0; i < bob.size(); ++i) to[i] = pendulum.place(mesh.points[bob[i]]);
    const auto outcome = stepper.step_border(bob, to, dt);
    if (!outcome) {
      std::puts(outcome.defect->message().c_str());
      return 1;
    }
    smallest = std::min(smallest, outcome.record.min_angle_deg);
    if (argc == 2 && before.speed > 0.0 && pendulum.speed <= 0.0)
      kinemesh::write_mesh(argv[1], stepper.mesh().domain());
    if (before.angle < 0.0 && pendulum.angle >= 0.0) {
      last = stepper.time() - dt * pendulum.angle / (pendulum.angle - before.angle);
      ++periods;
    }
  }

  const double exact = 4.0 * std::sqrt(length / g) * std::comp_ellint_1(sine);
  std::printf("%d periods of %.4f, exact %.4f; smallest angle %.1f\n", periods, last / periods, exact,
              smallest);
}
