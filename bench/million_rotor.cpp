// A disc turns in a still mesh of a million vertices and tangles it along its rim at every step: what each
// phase of a step costs, against a rebuild of the same points in the same run.
//
//   million_rotor [vertices [steps]]
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <vector>

#include "core/base/stopwatch.h"
#include "kinemesh/build.h"
#include "kinemesh/motion.h"
#include "kinemesh/shapes.h"
#include "kinemesh/stepper.h"
#include "kinemesh/validate.h"
#include "motion/fields/rigid.h"

namespace kinemesh {
namespace {

constexpr double turn_per_step = 2.0 * std::numbers::pi / 360.0;

struct Sums {
  double move = 0, detect = 0, explore = 0, triangulate = 0, splice = 0, total = 0;
  double rebuild = 0, rebuild_cgal = 0;

  void add(const StepRecord& record, const RepairRecord& remesh, double remesh_ms) {
    move += record.move_ms;
    detect += record.repair.detect_ms;
    explore += record.repair.explore_ms;
    triangulate += record.repair.triangulate_ms;
    splice += record.repair.splice_ms;
    total += record.total_ms;
    rebuild += remesh_ms;
    rebuild_cgal += remesh.triangulate_ms;
  }
};

void print_header() {
  std::printf("%4s %9s %8s %9s %9s | %8s %8s %8s %8s %8s %8s | %9s %9s\n", "step", "inverted", "regions",
              "replaced", "% of all", "move", "detect", "explore", "mesh", "splice", "step ms", "rebuild",
              "by CGAL");
}

void print(const StepRecord& record, int n_faces, const RepairRecord& remesh, double remesh_ms) {
  const auto& r = record.repair;
  std::printf("%4d %9d %8zu %9d %9.3f | %8.1f %8.1f %8.1f %8.1f %8.1f %8.1f | %9.1f %9.1f\n", record.step,
              r.inverted, r.regions.size(), r.replaced, 100.0 * r.replaced / n_faces, record.move_ms,
              r.detect_ms, r.explore_ms, r.triangulate_ms, r.splice_ms, record.total_ms, remesh_ms,
              remesh.triangulate_ms);
  std::fflush(stdout);
}

void print_means(const Sums& sums, int steps) {
  std::printf("%-43s | %8.1f %8.1f %8.1f %8.1f %8.1f %8.1f | %9.1f %9.1f\n", "mean", sums.move / steps,
              sums.detect / steps, sums.explore / steps, sums.triangulate / steps, sums.splice / steps,
              sums.total / steps, sums.rebuild / steps, sums.rebuild_cgal / steps);
  std::printf("a step takes 1/%.1f of a rebuild's time, 1/%.1f of CGAL's alone\n", sums.rebuild / sums.total,
              sums.rebuild_cgal / sums.total);
}

// Throws std::runtime_error with the defect where a mesh is not valid.
void require_valid(const std::optional<Defect>& defect) {
  if (defect) throw std::runtime_error(defect->message());
}

void run(int vertices, int steps) {
  const MeshData data = make_square(vertices);
  const Stopwatch building;
  Mesh mesh = build_mesh(data);
  std::printf("%d vertices, %d faces, built in %.0f ms\n", mesh.n_user_vertices(), mesh.n_user_faces(),
              building.milliseconds());
  const Motion motion(mesh, {{std::make_shared<Rotor>(Point(0.5, 0.5), 0.3, turn_per_step), {}}});
  Stepper stepper(std::move(mesh));
  const auto rebuild = make_strategy("remesh");
  Sums sums;
  print_header();
  for (int n = 1; n <= steps; ++n) {
    const StepOutcome outcome = stepper.step(motion, 1.0);
    require_valid(outcome.defect);
    Mesh copy = stepper.mesh();
    const Stopwatch rebuilding;
    const RepairOutcome rebuilt = rebuild->repair(copy, {});
    const double rebuild_ms = rebuilding.milliseconds();
    require_valid(rebuilt.defect);
    sums.add(outcome.record, rebuilt.record, rebuild_ms);
    print(outcome.record, stepper.mesh().n_faces(), rebuilt.record, rebuild_ms);
  }
  require_valid(validate(stepper.mesh()));
  print_means(sums, steps);
}

}  // namespace
}  // namespace kinemesh

int main(int argc, char** argv) try {
  kinemesh::run(argc > 1 ? std::atoi(argv[1]) : 1'000'000, argc > 2 ? std::atoi(argv[2]) : 20);
} catch (const std::exception& error) {
  std::fprintf(stderr, "million_rotor: %s\n", error.what());
  return 1;
}
