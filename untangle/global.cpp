#include "untangle/global.h"

#include <algorithm>

#include "core/stopwatch.h"
#include "untangle/global_walk.h"
#include "untangle/records.h"

namespace kinemesh {
namespace {

// After so many rings of neighbours the whole mesh is taken.
constexpr int max_rings = 4;

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
  if (tangles.empty()) return outcome;

  const Stopwatch exploring;
  walk_globally(mesh, tangles, regions_);
  record.explore_ms = exploring.milliseconds();

  const Stopwatch triangulating;
  outcome.defect = remesh_all(mesh, options);
  record.triangulate_ms = triangulating.milliseconds();
  if (outcome.defect) return outcome;

  const Stopwatch splicing;
  describe(mesh, tangles, record);
  for (const auto& work : work_) mesh.splice(work.patch);
  record.splice_ms = splicing.milliseconds();
  return outcome;
}

// Before any is spliced, so that a failure has nothing to undo.
std::optional<Defect> GlobalUntangling::remesh_all(const Mesh& mesh, const RepairOptions& options) {
  work_.assign(regions_.count(), {});
  for (int region = 0; region < regions_.count(); ++region) {
    if (auto defect = remesh(mesh, options, region)) return defect;
  }
  return std::nullopt;
}

std::optional<Defect> GlobalUntangling::remesh(const Mesh& mesh, const RepairOptions& options, int region) {
  if (regions_.faces(region).empty()) return std::nullopt;  // absorbed
  auto& work = work_[region];
  auto result = mesher_.run(mesh, regions_, region);
  while (result == RegionMesher::Result::NotSimple) {
    ++work.retries;
    enlarge(mesh, region);
    result = mesher_.run(mesh, regions_, region);
  }
  if (result == RegionMesher::Result::NoMesh) return mesher_.defect();
  auto finished = finish(mesh, regions_, region, std::move(mesher_.new_faces()), options.allow_escaped);
  if (finished.defect) return finished.defect;
  work.patch = std::move(finished.patch);
  work.escaped = finished.escaped;
  work.border_edges = mesher_.border_edges();
  work.centre = mesher_.centre();
  return std::nullopt;
}

// The safety net: adds the faces across the region's border, with the regions they belong to; in the end all
// faces.
void GlobalUntangling::enlarge(const Mesh& mesh, int region) {
  if (work_[region].retries > max_rings) {
    for (int face = 0; face < mesh.n_faces(); ++face) take(face, region);
  } else {
    const auto faces = regions_.faces(region);  // a copy: the set grows
    for (const int face : faces) {
      for (const int side : mesh.sides(face)) {
        const int across = mesh.face_of(Mesh::opposite(side));
        if (across != none) take(across, region);
      }
    }
  }
  regions_.sort(region);
}

void GlobalUntangling::take(int face, int region) {
  const int other = regions_.set_of(face);
  if (other == region) return;
  if (other == none) {
    regions_.add(face, region);
    return;
  }
  regions_.absorb(region, other);
  work_[region].retries += work_[other].retries;
  work_[other] = {};
}

void GlobalUntangling::describe(const Mesh& mesh, const Tangles& tangles, RepairRecord& record) const {
  const auto components = inverted_components(mesh, tangles.inverted);
  record.components = components.count;
  for (int region = 0; region < regions_.count(); ++region) {
    if (regions_.faces(region).empty()) continue;
    const auto& work = work_[region];
    auto line = describe_region(mesh, regions_.faces(region), tangles, components);
    line.border_edges = work.border_edges;
    line.retries = work.retries;
    line.centre = work.centre;
    record.replaced += static_cast<int>(line.faces.size());
    record.escaped += work.escaped;
    record.regions.push_back(std::move(line));
  }
  std::sort(record.regions.begin(), record.regions.end(), seeded_before);
}

}  // namespace kinemesh
