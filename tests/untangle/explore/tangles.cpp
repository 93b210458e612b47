#include "tests/untangle/explore/tangles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/cdt/triangulator.h"

namespace kinemesh::test {
namespace {

constexpr int smallest = 5, largest = 60;  // numbers of vertices
constexpr double margin = 1e-3;            // no inner vertex is closer to the border

struct Start {
  MeshData mesh;
  int n_border;  // these vertices come first
};

Point inner_point(Random& random) {
  return {random.uniform(margin, 1.0 - margin), random.uniform(margin, 1.0 - margin)};
}

// Corners, up to two more vertices on each side, the rest inside.
Start random_start(Random& random, int n_vertices) {
  Start start{};
  auto& points = start.mesh.points;
  points = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  const int on_sides = random.below(std::min(9, n_vertices - 4));
  for (int i = 0; i < on_sides; ++i) {
    const double t = random.uniform(margin, 1.0 - margin);
    const std::array<Point, 4> on{Point{t, 0.0}, {1.0, t}, {t, 1.0}, {0.0, t}};
    points.push_back(on[i % 4]);
  }
  start.n_border = static_cast<int>(points.size());
  while (static_cast<int>(points.size()) < n_vertices) points.push_back(inner_point(random));
  Triangulation triangulation;
  if (!Triangulator().triangulate(points, {}, triangulation)) start.mesh.triangles = triangulation.triangles;
  return start;
}

double kept_inside(double x) {
  return std::clamp(x, margin, 1.0 - margin);
}

// Out of the square and in again by reflection, so that no two vertices end on one line of the margin.
double reflected(double x) {
  const double span = 1.0 - 2.0 * margin;
  double t = std::fmod(std::abs(x - margin), 2.0 * span);
  if (t > span) t = 2.0 * span - t;
  return kept_inside(margin + t);
}

void move(Point& p, double dx, double dy) {
  p = {reflected(p.x + dx), reflected(p.y + dy)};
}

void jitter(Random& random, std::span<Point> points, double share) {
  const double scale = std::pow(10.0, random.uniform(-1.7, 0.0));
  for (Point& p : points) {
    const double dx = random.uniform(-scale, scale), dy = random.uniform(-scale, scale);
    if (random.uniform() < share) move(p, dx, dy);
  }
}

void exchange(Random& random, std::span<Point> points) {
  const int n = static_cast<int>(points.size());
  for (int i = 1 + random.below(1 + n / 2); i > 0; --i)
    std::swap(points[random.below(n)], points[random.below(n)]);
}

// Everything beyond a line through the square is folded back over it.
void fold(Random& random, std::span<Point> points) {
  for (int folds = 1 + random.below(3); folds > 0; --folds) {
    const double angle = random.uniform(0.0, 6.283185307179586);
    const Point normal{std::cos(angle), std::sin(angle)}, through = inner_point(random);
    const double depth = random.uniform(0.2, 1.0);
    for (Point& p : points) {
      const double beyond = (p.x - through.x) * normal.x + (p.y - through.y) * normal.y;
      if (beyond > 0.0) move(p, -(1.0 + depth) * beyond * normal.x, -(1.0 + depth) * beyond * normal.y);
    }
  }
}

void throw_anywhere(Random& random, std::span<Point> points) {
  for (Point& p : points) p = inner_point(random);
}

// A turn that fades to nothing away from its centre, stronger than the sheet can bear.
void twist(Random& random, std::span<Point> points) {
  const Point centre = inner_point(random);
  const double radius = random.uniform(0.2, 0.8), turn = random.uniform(1.0, 6.0);
  for (Point& p : points) {
    const double x = p.x - centre.x, y = p.y - centre.y, distance = std::hypot(x, y);
    if (distance >= radius) continue;
    const double angle = turn * (1.0 - distance / radius);
    p = {reflected(centre.x + std::cos(angle) * x - std::sin(angle) * y),
         reflected(centre.y + std::sin(angle) * x + std::cos(angle) * y)};
  }
}

double near_node(Random& random, double x) {
  constexpr double nodes = 16.0;
  const double node = std::clamp(std::round(nodes * x), 1.0, nodes - 1.0) / nodes;
  return node + std::ldexp(random.below(4001) - 2000, -62);
}

}  // namespace

MeshData random_tangle(std::uint64_t seed, Tangling tangling, int n_vertices) {
  Random random(seed);
  auto start = random_start(random, n_vertices);
  const std::span<Point> inner = std::span(start.mesh.points).subspan(start.n_border);
  switch (tangling) {
    case Tangling::Jitter:
      jitter(random, inner, 1.0);
      break;
    case Tangling::JitterSome:
      jitter(random, inner, random.uniform(0.05, 0.5));
      break;
    case Tangling::Exchange:
      exchange(random, inner);
      break;
    case Tangling::Fold:
      fold(random, inner);
      break;
    case Tangling::Throw:
      throw_anywhere(random, inner);
      break;
    case Tangling::Twist:
      twist(random, inner);
      break;
    case Tangling::ExchangeAndJitter:
      exchange(random, inner);
      jitter(random, inner, 1.0);
  }
  return std::move(start.mesh);
}

MeshData random_tangle(std::uint64_t seed) {
  Random random(~seed);
  const double share = random.uniform();
  const int n = smallest + static_cast<int>((largest + 1 - smallest) * share * share * share);
  return random_tangle(seed, static_cast<Tangling>(random.below(n_tanglings)), n);
}

MeshData nearly_degenerate_tangle(std::uint64_t seed) {
  auto mesh = random_tangle(seed);
  Random random(seed);
  for (Point& p : mesh.points) {
    const bool on_border = p.x == 0.0 || p.x == 1.0 || p.y == 0.0 || p.y == 1.0;
    if (!on_border) p = {near_node(random, p.x), near_node(random, p.y)};
  }
  return mesh;
}

}  // namespace kinemesh::test
