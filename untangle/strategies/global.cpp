#include "untangle/strategies/global.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/base/stopwatch.h"
#include "untangle/fill/records.h"

namespace kinemesh {
namespace {

// So many stay in the cache from their walk to their patch.
constexpr int faces_at_hand = 4096;

}  // namespace

RepairOutcome GlobalUntangling::repair(Mesh& mesh, const Move& move) {
  return *repair_within({mesh.n_faces(), mesh.n_faces()}, mesh, move);
}

std::optional<RepairOutcome> GlobalUntangling::repair_within(const Limits& limits, Mesh& mesh,
                                                             const Move& move) {
  const RepairOptions& options = move.options();
  RepairOutcome outcome;
  auto& record = outcome.record;
  const auto tangles = detect(mesh, move, record);
  if (tangles.empty()) {
    record.escaped = count_escaped(mesh, options);
    return outcome;
  }

  if (record.inverted + record.degenerate > limits.tangled) return std::nullopt;
  walk_.start(mesh, tangles, repair_.regions());
  walk_.give_up_beyond(limits.in_regions);
  outcome.defect = plan(mesh, options, record);
  if (outcome.defect) return outcome;
  if (walk_.is_too_far()) return std::nullopt;

  const Stopwatch splicing;
  splice(mesh, record);
  record.splice_ms = splicing.milliseconds();
  record.escaped = count_escaped(mesh, options);
  return outcome;
}

// The next regions are walked while those of the last walk are re-meshed.
std::optional<Defect> GlobalUntangling::plan(const Mesh& mesh, const RepairOptions& options,
                                             RepairRecord& record) {
  bool more = true;
  std::optional<Defect> defect;
  const auto walk = [&] {
    const Stopwatch exploring;
    more = more && walk_.advance(faces_at_hand);
    record.explore_ms += exploring.milliseconds();
  };
  const auto remesh = [&] {
    const Stopwatch triangulating;
    defect = repair_.remesh_taken(mesh, options);
    record.triangulate_ms += triangulating.milliseconds();
  };
  repair_.start();
  walk();
  for (bool is_last = false; !is_last && !defect && !walk_.is_too_far();) {
    const Stopwatch taking;
    repair_.take_new(mesh);
    record.triangulate_ms += taking.milliseconds();
    is_last = !more;
    parallel_pair(remesh, walk);
  }
  if (defect || walk_.is_too_far()) return defect;
  const Stopwatch retrying;
  defect = repair_.remesh_touching(mesh, options);
  record.triangulate_ms += retrying.milliseconds();
  return defect;
}

// Not before all regions have been re-meshed, so that a failure has nothing to undo.
void GlobalUntangling::splice(Mesh& mesh, RepairRecord& record) {
  record.regions.reserve(repair_.regions().count());
  for (const int region : regions_by_seed()) {
    auto& work = repair_.patch(region);
    record.components += work.record.components;
    record.replaced += static_cast<int>(work.patch.faces.size());
    record.regions.push_back(std::move(work.record));
  }
  for (int region = 0; region < repair_.regions().count(); ++region) mesh.splice(repair_.patch(region).patch);
}

// Those that have not been absorbed.
std::vector<int> GlobalUntangling::regions_by_seed() {
  struct Seeded {
    unsigned seed;  // none is the largest
    int region;
    auto operator<=>(const Seeded&) const = default;
  };
  std::vector<Seeded> seeded;
  for (int region = 0; region < repair_.regions().count(); ++region)
    if (const auto& record = repair_.patch(region).record; !record.faces.empty())
      seeded.push_back({static_cast<unsigned>(record.seed), region});
  std::ranges::sort(seeded);
  std::vector<int> regions(seeded.size());
  std::ranges::transform(seeded, regions.begin(), &Seeded::region);
  return regions;
}

}  // namespace kinemesh
