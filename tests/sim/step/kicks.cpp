#include "tests/sim/step/kicks.h"

#include <algorithm>
#include <cmath>

#include "kinemesh/build.h"
#include "tests/sim/helpers.h"

namespace kinemesh::test {
namespace {

// Of two_labels(12): left and right of the interface, and the hole.
int zone(const Point& p) {
  const bool in_hole = std::max(std::abs(p.x - 0.5), std::abs(p.y - 0.5)) <= 1.0 / 12;
  return p.x <= 0.25 ? 0 : in_hole ? 1 : 2;
}

}  // namespace

MeshData two_labels(int n) {
  MeshData data = grid_with_hole(n, n / 2 - 1, n / 2 + 1);
  for (const auto& t : data.triangles) data.labels.push_back(data.points[t[0]].x < 0.25 ? 7 : 3);
  return data;
}

Stepper stepper_on(const MeshData& data, const StepperOptions& options) {
  return Stepper(build_mesh(data, {.frame = 0.25, .fixed = {}}), options);
}

std::vector<Point> kicked(const Stepper& stepper, double kick, std::mt19937& random) {
  const Mesh& mesh = stepper.mesh();
  std::uniform_real_distribution<double> way(-kick, kick);
  auto next = mesh.user_positions();
  for (const UserVertex u : Numbers<UserVertex>(mesh.n_user_vertices())) {
    const Point to{std::clamp(next[u].x + way(random), 0.01, 0.99),
                   std::clamp(next[u].y + way(random), 0.01, 0.99)};
    if (!mesh.is_constrained(mesh.vertex_of_user(u)) && zone(to) == zone(next[u])) next[u] = to;
  }
  return next;
}

std::vector<StepperOptions> all_ways() {
  std::vector<StepperOptions> all;
  for (const char* strategy : {"global", "local", "remesh", "kinetic", "auto"})
    for (const char* quality : {"none", "delaunay", "smooth", "angles"})
      for (const bool retain : {false, true})
        all.push_back({.strategy = strategy, .retain = retain, .quality = quality});
  return all;
}

std::string name_of(const StepperOptions& options) {
  return options.strategy + " " + options.quality + (options.retain ? " retain" : "");
}

}  // namespace kinemesh::test
