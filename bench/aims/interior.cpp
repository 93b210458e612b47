// The interior's increments while the cylinder in a channel moves, against CGAL's triangulation of the same
// points.
#include "motion/interior/interior.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "aims.h"
#include "core/base/stopwatch.h"
#include "core/cdt/triangulator.h"
#include "kinemesh/build.h"
#include "kinemesh/measure.h"
#include "kinemesh/shapes.h"
#include "sim/step/threads.h"

namespace kinemesh::aims {
namespace {

constexpr int repeats = 5;
constexpr int small = 10'000;  // vertices, to compare with
constexpr double way = 0.3;    // of the cylinder in a step, in spacings
constexpr double turn = 0.05;  // of its direction from step to step, in radians

// The mesh of a step is that of the last one with its vertices moved; a step starts from what the last one
// found.
class Channel {
 public:
  explicit Channel(int n)
      : mesh_(build_mesh(make_channel(n))),
        spacing_(mean_spacing(mesh_)),
        roles_(mesh_.n_vertices(), Role::Free),
        increments_(mesh_.n_vertices(), Point(0.0, 0.0)),
        interior_(mesh_, {}) {
    for (const auto& marker : mesh_.markers())
      for (const auto& edge : marker.edges)
        for (const int user : edge) add(mesh_.vertex_of_user(UserVertex(user)), marker.name == "cylinder");
  }

  void step() {
    ++steps_;
    for (const Vertex v : cylinder_)
      increments_[v] = way * spacing_ * Point(std::cos(turn * steps_), std::sin(turn * steps_));
    const Stopwatch stopwatch;
    const auto solution = interior_.solve(mesh_, {.roles = roles_, .tangents = {}}, increments_);
    times_.push_back(stopwatch.milliseconds());
    if (!solution.converged) throw std::runtime_error("the interior does not converge");
    iterations_ = solution.iterations;
    for (const Vertex v : mesh_.vertices()) mesh_.positions()[v] += increments_[v];
    require_valid(mesh_);
  }

  void forget_time() { times_.clear(); }
  void rebuild() {
    Triangulator triangulator;
    Triangulation triangulation;
    if (triangulator.triangulate(mesh_.positions(), {}, triangulation))
      throw std::logic_error("points that coincide");
    rebuilds_.push_back(triangulator.milliseconds());
  }

  double solve_ms() const { return median(times_); }
  double rebuild_ms() const { return median(rebuilds_); }
  int iterations() const { return iterations_; }
  int n_vertices() const { return mesh_.n_vertices(); }

 private:
  void add(Vertex v, bool is_on_cylinder) {
    if (roles_[v] == Role::Known) return;
    roles_[v] = Role::Known;
    if (is_on_cylinder) cylinder_.push_back(v);
  }

  Mesh mesh_;
  double spacing_;
  std::vector<Role> roles_;
  std::vector<Vertex> cylinder_;
  std::vector<Point> increments_;
  Interior interior_;
  int steps_ = 0, iterations_ = 0;
  std::vector<double> times_, rebuilds_;  // ms
};

Channel measured(int n) {
  Channel channel(n);
  channel.step();
  channel.forget_time();  // the first one starts from nothing
  for (int i = 0; i < repeats; ++i) {
    channel.step();
    channel.rebuild();
  }
  return channel;
}

}  // namespace

void interior(int n) {
  const ThreadLimit one(1);
  const Channel channel = measured(n);
  report({"interior, two solutions / CGAL's rebuild", Aim::Kind::AtMost, n < 30'000 ? 3.0 : 4.0,
          channel.solve_ms() / channel.rebuild_ms(),
          fmt::format("{} vertices; {:.4g} ms; {} iterations; CGAL {:.4g} ms", channel.n_vertices(),
                      channel.solve_ms(), channel.iterations(), channel.rebuild_ms())});
  if (n < 10 * small) return;
  const Channel other = measured(small);
  report({"interior, power of n in the growth of its time", Aim::Kind::AtMost, 1.15,
          std::log(channel.solve_ms() / other.solve_ms()) /
              std::log(1.0 * channel.n_vertices() / other.n_vertices()),
          fmt::format("{} vertices: {:.4g} ms", other.n_vertices(), other.solve_ms())});
}

}  // namespace kinemesh::aims
