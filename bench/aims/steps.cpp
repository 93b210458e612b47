// A whole step without its move, against CGAL's triangulation of the same points.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "aims.h"
#include "sim/bench.h"
#include "sim/threads.h"

namespace kinemesh::aims {
namespace {

constexpr int steps = 5;

struct Regime {
  std::string what;
  std::string motion;  // of [[motion]]
  std::string strategy = "global";
  std::string quality = "none";
  Aim::Kind kind = Aim::Kind::AtLeast;
  double aim;  // times as fast; at most: times as long
};

const Regime regimes[] = {
    {.what = "rotor",
     .motion = "field = \"rotor\"\nradius = 0.3\nrate = 0.0174533\ncenter = [0.5, 0.5]",
     .aim = 100.0},
    {.what = "jitter 0.01", .motion = "field = \"jitter\"\namplitude = 0.01", .aim = 120.0},
    {.what = "jitter 0.05", .motion = "field = \"jitter\"\namplitude = 0.05", .aim = 40.0},
    {.what = "jitter 0.2", .motion = "field = \"jitter\"\namplitude = 0.2", .aim = 6.0},
    {.what = "jitter 1.0 with auto",
     .motion = "field = \"jitter\"\namplitude = 1.0",
     .strategy = "auto",
     .kind = Aim::Kind::AtMost,
     .aim = 1.1},
    {.what = "jitter 0.01 kept Delaunay",
     .motion = "field = \"jitter\"\namplitude = 0.01",
     .quality = "delaunay",
     .aim = 12.0},
};

Scenario scenario_of(const Regime& regime, int n) {
  return parse_scenario(fmt::format("[mesh]\nshape = \"square\"\nvertices = {}\nframe = "
                                    "0.0\n[[motion]]\n{}\n[time]\ndt = 1.0\nsteps = {}\n"
                                    "[repair]\nquality = \"{}\"\n",
                                    n, regime.motion, steps, regime.quality),
                        regime.what);
}

// From the smallest number on, and then ascending.
std::vector<Triangle> sorted_triangles(const Mesh& mesh) {
  auto triangles = mesh.domain().triangles;
  for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

struct Times {
  std::vector<double> step, measuring, cgal, rebuild;  // ms
  std::vector<Triangle> ours;  // of a last step that has to have the rebuild's triangles
};

void take(const Round& round, bool compares, Times& times) {
  const auto& record = round.record;
  if (!record.accepted) throw std::runtime_error(round.strategy + " found no valid mesh");
  const double step = record.total_ms - record.move_ms;
  const bool is_rebuild = round.strategy == "remesh";
  (is_rebuild ? times.rebuild : times.step).push_back(step);
  if (!is_rebuild) times.measuring.push_back(record.measure_ms);
  if (is_rebuild) times.cgal.push_back(record.repair.triangulate_ms);
  if (!compares || record.step != steps) return;
  if (!is_rebuild) times.ours = sorted_triangles(round.mesh);
  if (is_rebuild && times.ours != sorted_triangles(round.mesh))
    throw std::logic_error("another triangulation than the rebuild's");
}

void measure(const Regime& regime, int n) {
  Times times;
  const std::vector<std::string> strategies{regime.strategy, "remesh"};
  const bool compares = regime.quality == "delaunay";
  const auto stopped = compare_strategies(scenario_of(regime, n), strategies,
                                          [&](const Round& round) { take(round, compares, times); });
  if (stopped) throw std::runtime_error(*stopped);
  const double step = median(times.step), cgal = median(times.cgal), rebuild = median(times.rebuild);
  const bool at_most = regime.kind == Aim::Kind::AtMost;
  const std::string tail = compares ? "; the same triangles" : "";
  report({regime.what + (at_most ? ": step / CGAL's rebuild" : ": CGAL's rebuild / step"), regime.kind,
          regime.aim, at_most ? step / cgal : cgal / step,
          fmt::format(
              "step {:.4g} ms; of it {:.4g} to measure angles and areas; CGAL alone {:.4g} ms; whole re-mesh "
              "step {:.4g} ms{}",
              step, median(times.measuring), cgal, rebuild, tail)});
  if (!at_most) return;
  report({regime.what + ": step / whole step of `remesh`", regime.kind, regime.aim, step / rebuild,
          fmt::format("step {:.4g} ms; `remesh` {:.4g} ms", step, rebuild)});
}

}  // namespace

void whole_steps(int n) {
  const ThreadLimit one(1);
  for (const auto& regime : regimes) measure(regime, n);
}

}  // namespace kinemesh::aims
