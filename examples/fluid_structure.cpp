// A cylinder on a spring in a channel: a structure moves a border, the mesh between follows.
// docs/embedding.md shows it in pieces.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <span>
#include <string_view>
#include <vector>

#include "kinemesh/build.h"
#include "kinemesh/shapes.h"
#include "kinemesh/stepper.h"
#include "kinemesh/validate.h"

namespace {

// Stands for yours: forces on a border in, nothing but the mesh's vertices and triangles needed.
struct Fluid {
  std::vector<kinemesh::Point> x;  // of all vertices
  std::vector<kinemesh::Point> w;  // their velocity, for ALE

  explicit Fluid(const kinemesh::MeshData& mesh) : x(mesh.points), w(x.size(), kinemesh::Point(0.0, 0.0)) {}

  double lift(double t) const { return 1.5 * std::sin(6.0 * t); }

  void follow(std::span<const kinemesh::Point> now, double dt) {
    for (std::size_t v = 0; v < x.size(); ++v) w[v] = (now[v] - x[v]) / dt;
    std::ranges::copy(now, x.begin());
  }
};

struct Spring {
  double y = 0.0, speed = 0.0;

  void advance(double force, double dt) {
    speed += dt * (force - 20.0 * y - speed);
    y += dt * speed;
  }
};

std::vector<kinemesh::UserVertex> vertices_of(const kinemesh::MeshData& mesh, std::string_view marker) {
  std::vector<kinemesh::UserVertex> vertices;
  for (const auto& [name, edges] : mesh.markers)
    if (name == marker)
      for (const auto& [from, to] : edges)
        vertices.insert(vertices.end(), {kinemesh::UserVertex(from), kinemesh::UserVertex(to)});
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace

int main() {
  const kinemesh::MeshData mesh = kinemesh::make_channel(2000);
  kinemesh::Stepper stepper(kinemesh::build_mesh(mesh), {.quality = "angles", .angle = 20.0});
  const std::vector<kinemesh::UserVertex> wall = vertices_of(mesh, "cylinder");
  std::vector<kinemesh::Point> to(wall.size());
  Fluid fluid(mesh);
  Spring spring;

  const double dt = 0.02;
  double smallest = 60.0;
  for (int n = 0; n < 100; ++n) {
    spring.advance(fluid.lift(stepper.time()), dt);
    for (std::size_t i = 0; i < wall.size(); ++i)
      to[i] = mesh.points[wall[i]] + kinemesh::Point(0.0, spring.y);
    const auto outcome = stepper.step_border(wall, to, dt);
    if (!outcome) {
      std::puts(outcome.message().c_str());  // the mesh is as it was before the step
      return 1;
    }
    fluid.follow(stepper.positions(), dt);
    smallest = std::min(smallest, outcome.record.min_angle_deg);
  }

  std::printf("%d steps, smallest angle %.1f\n", stepper.steps_done(), smallest);
  return kinemesh::validate(stepper.mesh()) ? 1 : 0;
}
