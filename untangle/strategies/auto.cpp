#include "untangle/strategies/auto.h"

#include "core/base/stopwatch.h"

namespace kinemesh {
namespace {

// Shares of all faces. Where vertices jump at random, the regions hold about half of the mesh when a seventh
// of it is tangled, and a new triangulation of everything then costs about what they do
// (docs/algorithm.md, "Auto").
constexpr double most_tangled = 1.0 / 7;
constexpr double most_in_regions = 1.0 / 2;

}  // namespace

RepairOutcome AutomaticRepair::repair(Mesh& mesh, const Move& move) {
  const Stopwatch trying;
  const GlobalUntangling::Limits limits{static_cast<int>(most_tangled * mesh.n_faces()),
                                        static_cast<int>(most_in_regions * mesh.n_faces())};
  if (auto outcome = global_.repair_within(limits, mesh, move)) return std::move(*outcome);
  const double tried_ms = trying.milliseconds();
  auto outcome = remesh_.repair(mesh, move);
  outcome.record.explore_ms += tried_ms;
  return outcome;
}

}  // namespace kinemesh
