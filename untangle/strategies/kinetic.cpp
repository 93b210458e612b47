#include "untangle/strategies/kinetic.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/stopwatch.h"
#include "kinemesh/error.h"
#include "untangle/fill/hole.h"
#include "untangle/fill/records.h"
#include "untangle/walk/detect.h"

namespace kinemesh {
namespace {

void require_before(const Mesh& mesh, std::span<const Point> before) {
  if (static_cast<int>(before.size()) == mesh.n_vertices()) return;
  throw InputError("strategy kinetic: " + std::to_string(before.size()) +
                   " positions before the move, those of all " + std::to_string(mesh.n_vertices()) +
                   " vertices expected; a step has them, a file alone has not");
}

}  // namespace

RepairOutcome KineticUntangling::repair(Mesh& mesh, const Move& move) {
  require_before(mesh, move.before());
  RepairOutcome outcome;
  auto& record = outcome.record;
  const auto tangles = detect(mesh, move, record);

  const Stopwatch moving;
  Undo undo(mesh);
  KineticFlips flips(undo, move.before());
  const bool is_upright = flips.run();
  counts_ = flips.counts();
  record.explore_ms = moving.milliseconds();

  const Stopwatch replacing;
  outcome.defect = replace_tangles(undo, is_upright ? Tangles{} : detect(mesh), move.options().allow_escaped);
  record.triangulate_ms = replacing.milliseconds();
  if (outcome.defect) return outcome;

  // Regions are described as they were.
  const Stopwatch describing;
  record.escaped = count_escaped(mesh, move.options());
  const auto rewritten = undo.rewritten_faces();
  undo.look_back(rewritten, [&] {
    find_regions(mesh, rewritten);
    describe_regions(mesh, record);
  });
  record.splice_ms = describing.milliseconds();
  return outcome;
}

// As `global` does. Nothing has been spliced if there is no valid mesh.
std::optional<Defect> KineticUntangling::replace_tangles(Undo& undo, const Tangles& tangles,
                                                         bool allow_escaped) {
  const RepairOptions options{.allow_escaped = allow_escaped};
  walk_.run(undo.mesh(), tangles, replaced_.regions());
  replaced_.start();
  if (auto defect = replaced_.remesh_new(undo.mesh(), options)) return defect;
  if (auto defect = replaced_.remesh_touching(undo.mesh(), options)) return defect;
  for (int region = 0; region < replaced_.regions().count(); ++region)
    undo.splice(replaced_.patch(region).patch);
  return std::nullopt;
}

// In the connectivity before, connected across edges. What has been flipped or replaced together hangs
// together: flips and replacements only divide the polygon of their faces anew.
void KineticUntangling::find_regions(const Mesh& mesh, std::span<const Face> rewritten) {
  regions_.reset(mesh.n_faces());
  is_rewritten_.assign(mesh.n_faces(), false);
  for (const Face face : rewritten) is_rewritten_[face] = true;
  std::vector<Face> pending;
  const auto take = [&](Face face, int region) {
    if (face == none || !is_rewritten_[face] || regions_.set_of(face) != none) return;
    regions_.add(face, region);
    pending.push_back(face);
  };
  for (const Face first : rewritten) {
    if (regions_.set_of(first) != none) continue;
    const int region = regions_.open();
    take(first, region);
    while (!pending.empty()) {
      const Face face = pending.back();
      pending.pop_back();
      for (const Side side : Mesh::sides(face)) take(mesh.face_across(side), region);
    }
    regions_.sort(region);
  }
}

void KineticUntangling::describe_regions(const Mesh& mesh, RepairRecord& record) {
  auto& records = record.regions;
  records.resize(regions_.count());
  parallel_parts(regions_.count(), grain::regions, [&](int, int begin, int end) {
    Hole hole;
    for (int region = begin; region < end; ++region) {
      hole.dig(mesh, regions_, region);
      records[region] = describe_region(mesh, hole);
    }
  });
  for (int region = 0; region < replaced_.regions().count(); ++region) {
    const auto& [patch, replaced] = replaced_.patch(region);
    if (patch.faces.empty()) continue;  // absorbed
    auto& around = records[regions_.set_of(patch.faces.front())];
    around.fallback = true;
    around.retries += replaced.retries;
  }
  std::sort(records.begin(), records.end(), is_seeded_before);
  for (const auto& region : records) record.components += region.components;
  record.replaced = record.region_faces();
}

}  // namespace kinemesh
