// Angles made good in a mesh of slivers: step 60 of an airfoil that turns within layers, kept Delaunay until
// then.
#include "untangle/quality/angles.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "aims.h"
#include "core/base/stopwatch.h"
#include "core/cdt/triangulator.h"
#include "kinemesh/measure.h"
#include "kinemesh/scenario.h"
#include "kinemesh/setup.h"
#include "sim/step/threads.h"

namespace kinemesh::aims {
namespace {

constexpr int repeats = 9;
constexpr double wanted = 25.0;  // degrees

constexpr const char* turning_airfoil = R"toml(
[mesh]
shape = "airfoil"
vertices = {}
[[motion]]
field = "expression"
u = "-pi^2 * sin(pi * t) * y"
v = "pi^2 * sin(pi * t) * (x - 0.5)"
on = "marker:airfoil"
blend = [0.6, 2.0]
[time]
steps = 60
dt = 0.01
[repair]
quality = "delaunay"
)toml";

Mesh after_its_steps(int n) {
  const Scenario scenario = parse_scenario(fmt::format(turning_airfoil, n), "turning_airfoil.toml");
  auto [mesh, motion, notes] = set_up(scenario);
  Stepper stepper(std::move(mesh), stepper_options(scenario.repair, motion));
  for (int step = 1; step <= scenario.time.steps; ++step)
    if (const auto outcome = stepper.step_to(motion, scenario.time.time_after(step)); !outcome)
      throw std::runtime_error(outcome.defect->message());
  return stepper.mesh();
}

}  // namespace

void angles(int n) {
  const ThreadLimit one(1);
  const Mesh before = after_its_steps(n);
  Triangulator triangulator;
  Triangulation triangulation;
  std::vector<double> times, rebuilds;  // ms
  AngleCounts counts;
  double worst = 60.0;
  for (int i = 0; i < repeats; ++i) {
    Mesh mesh = before;
    AngleUpkeep upkeep(mesh, {.angle = wanted});
    const Stopwatch stopwatch;
    counts = upkeep.run(mesh);
    times.push_back(stopwatch.milliseconds());
    require_valid(mesh);
    worst = std::min(worst, measure(mesh).min_angle_deg);
    if (triangulator.triangulate(before.positions(), {}, triangulation))
      throw std::logic_error("points that coincide");
    rebuilds.push_back(triangulator.milliseconds());
  }
  report({"angles of a sheared mesh, degrees", Aim::Kind::AtLeast, wanted, worst,
          fmt::format("{} vertices; {:.3g} degrees before; {} flips; {} moves", before.n_user_vertices(),
                      measure(before).min_angle_deg, counts.flips, counts.moves)});
  report({"angles of a sheared mesh / CGAL's rebuild", Aim::Kind::AtMost, 2.5,
          median(times) / median(rebuilds),
          fmt::format("{:.4g} ms; CGAL {:.4g} ms", median(times), median(rebuilds))});
}

}  // namespace kinemesh::aims
