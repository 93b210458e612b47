#include "motion/following.h"

#include <algorithm>
#include <utility>

#include "core/base/parallel.h"
#include "motion/border.h"

namespace kinemesh {
namespace {

// Vertices of a line from one that is held to the next, both included; positions in line.vertices(). Over the
// end of a closed line it goes on with the first ones.
struct Stretch {
  std::size_t begin, length;
};

std::vector<Stretch> stretches_of(const SlideLine& line, std::span<const Role> roles) {
  const auto vertices = line.vertices();
  const std::size_t n = vertices.size();
  std::vector<std::size_t> held;
  for (std::size_t i = 0; i < n; ++i)
    if (roles[vertices[i]] != Role::Slide || (!line.is_closed() && (i == 0 || i + 1 == n))) held.push_back(i);
  std::vector<Stretch> stretches;
  for (std::size_t k = 0; k + 1 < held.size(); ++k) stretches.push_back({held[k], held[k + 1] - held[k] + 1});
  if (line.is_closed() && !held.empty())
    stretches.push_back({held.back(), n - held.back() + held.front() + 1});
  return stretches;
}

// Whether vertices have kept their order, and if not, spreads those within the stretch as they were.
void keep_order(const SlideLine& line, const Stretch& stretch, std::span<const Point> x0,
                std::span<Point> x1) {
  const auto vertices = line.vertices();
  std::vector<double> before, after;
  const auto unrolled = [&](std::vector<double>& all, double parameter) {
    while (line.is_closed() && !all.empty() && parameter < all.front()) parameter += line.length();
    all.push_back(parameter);
  };
  const auto vertex = [&](std::size_t i) { return vertices[(stretch.begin + i) % vertices.size()]; };
  for (std::size_t i = 0; i < stretch.length; ++i) {
    unrolled(before, line.parameter_near(x0[vertex(i)]));
    unrolled(after, line.parameter_near(x1[vertex(i)]));
  }
  if (std::ranges::adjacent_find(after, std::greater_equal<>()) == after.end()) return;
  const double scale = (after.back() - after.front()) / (before.back() - before.front());
  for (std::size_t i = 1; i + 1 < stretch.length; ++i)
    x1[vertex(i)] = line.at(after.front() + scale * (before[i] - before.front()));
}

// Adding 0 would turn -0 into +0.
void add(Point& x, const Point& way) {
  if (way.x != 0.0) x.x += way.x;
  if (way.y != 0.0) x.y += way.y;
}

}  // namespace

Following::Following(const Mesh& mesh, const InteriorOptions& options, FollowingState state)
    : interior_(mesh, options), state_(std::move(state)) {}

InteriorSolution Following::follow(const Mesh& mesh, const Motion& motion, const TimeStep& step,
                                   std::span<Point> x1) {
  const auto x0 = mesh.positions();
  const auto roles = motion.roles();
  ways_.resize(x0.size());
  const bool has_ways = motion.ways_inside(x0, step, ways_);
  tangents_.clear();
  for (const Vertex v : mesh.vertices())
    if (roles[v] == Role::Slide) tangents_.emplace(v, motion.freedom().tangent(v, x0[v]));
  const auto ways = has_ways ? std::span<const Point>(ways_) : std::span<const Point>();
  const InteriorSolution solution = solve(mesh, roles, ways, step.dt, x1);
  if (!solution.converged) return solution;
  for (const Vertex v : mesh.vertices()) {
    if (roles[v] == Role::Known) continue;
    add(x1[v], next_.increments[v]);
    if (roles[v] == Role::Slide && next_.increments[v] != Point(0.0, 0.0))
      x1[v] = motion.freedom().on_line(v, x0[v], x1[v]);
  }
  for (const SlideLine& line : motion.freedom().lines())
    for (const Stretch& stretch : stretches_of(line, roles)) keep_order(line, stretch, x0, x1);
  return solution;
}

InteriorSolution Following::follow(const Mesh& mesh, std::span<const Role> roles, double dt,
                                   std::span<Point> x1) {
  tangents_.clear();
  const InteriorSolution solution = solve(mesh, roles, {}, dt, x1);
  for (const Vertex v : mesh.vertices())
    if (roles[v] == Role::Free) add(x1[v], next_.increments[v]);
  return solution;
}

// A border is asked to go where x1 has it, less what its interior does by itself.
InteriorSolution Following::solve(const Mesh& mesh, std::span<const Role> roles, std::span<const Point> ways,
                                  double dt, std::span<const Point> x1) {
  const auto x0 = mesh.positions();
  next_.dt = dt;
  next_.increments.resize(x0.size());
  const bool has_start = !state_.increments.empty() && state_.dt > 0.0;
  const double scale = has_start ? dt / state_.dt : 0.0;
  parallel_parts(static_cast<int>(x0.size()), grain::moves, [&](int, int begin, int end) {
    for (Vertex v(begin); v < end; ++v) {
      Point& u = next_.increments[v];
      if (roles[v] == Role::Known)
        u = ways.empty() ? x1[v] - x0[v] : x1[v] - x0[v] - ways[v];
      else
        u = has_start ? scale * state_.increments[v] : Point(0.0, 0.0);
    }
  });
  return interior_.solve(mesh, {roles, tangents_, ways}, next_.increments);
}

void Following::accept() {
  std::swap(state_, next_);
}

}  // namespace kinemesh
