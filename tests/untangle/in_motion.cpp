#include "tests/untangle/in_motion.h"

#include <algorithm>

#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/oracle.h"
#include "tests/untangle/properties.h"
#include "tests/untangle/random_tangles.h"
#include "tests/untangle/repairs.h"
#include "untangle/strategies/kinetic.h"
#include "untangle/walk/detect.h"

namespace kinemesh::test {
namespace {

int count_fallbacks(const RepairRecord& record) {
  return static_cast<int>(std::count_if(record.regions.begin(), record.regions.end(),
                                        [](const RegionRecord& r) { return r.fallback; }));
}

// Tangles of the connectivity before at the positions after: each lies in a region.
std::string miscounted(const Mesh& moved, const RepairRecord& record) {
  const auto tangles = detect(moved);
  int inverted = 0, flat = 0;
  for (const auto& region : record.regions) {
    inverted += region.inverted;
    flat += region.degenerate;
  }
  const bool is_right = inverted == static_cast<int>(tangles.inverted.size()) &&
                        inverted == record.inverted && flat == static_cast<int>(tangles.flat.size()) &&
                        flat == record.degenerate &&
                        record.components == static_cast<int>(oracle::inverted_components(moved).size());
  return is_right ? "" : "tangles miscounted";
}

}  // namespace

std::string check_in_motion(const Mesh& moved, std::span<const Point> before, MotionTotals& totals) {
  Mesh mesh = moved, other = moved;
  KineticUntangling kinetic;
  const auto outcome = kinetic.repair(mesh, Move({.allow_escaped = true}, before));
  totals.events += kinetic.counts().events;
  totals.flips += kinetic.counts().flips;
  totals.stuck += kinetic.counts().stuck;
  if (static_cast<bool>(outcome) != static_cast<bool>(repair(other, true)))
    return outcome ? "claims a mesh where none exists" : "failed: " + outcome.defect->message();
  ++(outcome ? totals.repaired : totals.failed);
  if (!outcome) return snapshot_of(mesh) == snapshot_of(moved) ? "" : "a failure left its traces";
  totals.replacements += count_fallbacks(outcome.record) > 0;
  const auto wrong = contract_broken(moved, mesh, outcome);
  return wrong.empty() ? miscounted(moved, outcome.record) : wrong;
}

std::string check_tangles_in_motion(std::uint64_t seed) {
  for (const auto make : {random_tangle, lattice_tangle, polyomino_tangle}) {
    const auto tangle = make(seed);
    MotionTotals totals;
    const auto wrong = check_in_motion(tangle.mesh, tangle.before, totals);
    if (!wrong.empty()) return tangle.about + " " + std::to_string(seed) + ": " + wrong;
  }
  return "";
}

}  // namespace kinemesh::test
