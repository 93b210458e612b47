// Signs: far from zero, where the filter tells them, and at zero, where it does not.
#include <benchmark/benchmark.h>

#include <random>
#include <string>
#include <vector>

#include "kinemesh/predicates.h"

namespace kinemesh::bench {
namespace {

constexpr int n = 4096;

std::vector<Point> random_points() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Point> points(n);
  for (Point& p : points) p = {unit(random), unit(random)};
  return points;
}

// All on one line and on one circle, exactly.
std::vector<Point> degenerate_points() {
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) points.emplace_back(i % 2 == 0 ? 1.0 : -1.0, i % 4 < 2 ? 1.0 : -1.0);
  return points;
}

std::vector<Point> points_for(benchmark::State& state) {
  return state.range(0) == 0 ? random_points() : degenerate_points();
}

template <class Predicate>
void call(benchmark::State& state, const Predicate& predicate) {
  const auto points = points_for(state);
  for (auto _ : state)
    for (int i = 0; i + 3 < n; ++i) benchmark::DoNotOptimize(predicate(&points[i]));
  state.SetItemsProcessed(state.iterations() * (n - 3));
}

void orientation_of(benchmark::State& state) {
  call(state, [&](const Point* p) { return orientation(p[0], p[1], state.range(0) == 0 ? p[2] : p[0]); });
}

void in_circle_of(benchmark::State& state) {
  call(state, [](const Point* p) { return in_circle(p[0], p[1], p[2], p[3]); });
}

void segments_cross_of(benchmark::State& state) {
  call(state, [](const Point* p) { return segments_cross(p[0], p[1], p[2], p[3]); });
}

void interiors_overlap_of(benchmark::State& state) {
  call(state, [](const Point* p) { return interiors_overlap({p[0], p[1], p[2]}, {p[1], p[2], p[3]}); });
}

BENCHMARK(orientation_of)->ArgName("degenerate")->Arg(0)->Arg(1);
BENCHMARK(in_circle_of)->ArgName("degenerate")->Arg(0)->Arg(1);
BENCHMARK(segments_cross_of)->ArgName("degenerate")->Arg(0)->Arg(1);
BENCHMARK(interiors_overlap_of)->ArgName("degenerate")->Arg(0)->Arg(1);

}  // namespace
}  // namespace kinemesh::bench
