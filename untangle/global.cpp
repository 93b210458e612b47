#include "untangle/global.h"

#include <algorithm>
#include <stdexcept>

#include "core/stopwatch.h"
#include "untangle/records.h"

namespace kinemesh {
namespace {

// By the number users know them by; those of padding only at the end.
bool seeded_before(const RegionRecord& a, const RegionRecord& b) {
  return std::pair(a.seed == none, a.seed) < std::pair(b.seed == none, b.seed);
}

}  // namespace

RepairOutcome GlobalUntangling::repair(Mesh& mesh, const RepairOptions& options) {
  RepairOutcome outcome;
  auto& record = outcome.record;
  const Stopwatch detecting;
  const auto tangles = detect(mesh);
  record.inverted = static_cast<int>(tangles.inverted.size());
  record.degenerate = static_cast<int>(tangles.flat.size());
  record.detect_ms = detecting.milliseconds();
  if (tangles.empty()) {
    record.escaped = count_escaped(mesh, options);
    return outcome;
  }

  const Stopwatch exploring;
  walk_.run(mesh, tangles, repair_.regions());
  record.explore_ms = exploring.milliseconds();

  const Stopwatch triangulating;
  outcome.defect = remesh(mesh, options);
  record.triangulate_ms = triangulating.milliseconds();
  if (outcome.defect) return outcome;

  const Stopwatch splicing;
  describe(mesh, tangles, record);
  for (int region = 0; region < repair_.regions().count(); ++region) mesh.splice(repair_.patch(region).patch);
  record.splice_ms = splicing.milliseconds();
  record.escaped = count_escaped(mesh, options);
  return outcome;
}

// Before any is spliced, so that a failure has nothing to undo.
std::optional<Defect> GlobalUntangling::remesh(const Mesh& mesh, const RepairOptions& options) {
  repair_.start();
  for (int region = 0; region < repair_.regions().count(); ++region) {
    if (auto defect = repair_.remesh(mesh, options, region)) return defect;
  }
  return std::nullopt;
}

void GlobalUntangling::describe(const Mesh& mesh, const Tangles& tangles, RepairRecord& record) const {
  const auto components = inverted_components(mesh, tangles.inverted);
  record.components = components.count;
  for (int region = 0; region < repair_.regions().count(); ++region) {
    if (repair_.regions().faces(region).empty()) continue;  // absorbed
    const auto& patch = repair_.patch(region);
    auto line = describe_region(mesh, repair_.regions(), region, tangles, components);
    line.kept = patch.kept;
    line.retries = patch.retries;
    record.replaced += static_cast<int>(patch.patch.faces.size());
    record.regions.push_back(std::move(line));
  }
  std::sort(record.regions.begin(), record.regions.end(), seeded_before);
}

}  // namespace kinemesh
