#include "untangle/kinetic.h"

#include <algorithm>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/error.h"
#include "core/stopwatch.h"
#include "untangle/detect.h"
#include "untangle/quality/delaunay_flipping.h"
#include "untangle/records.h"

namespace kinemesh {
namespace {

void require_before(const Mesh& mesh, std::span<const Point> before) {
  if (static_cast<int>(before.size()) == mesh.n_vertices()) return;
  throw InputError("strategy kinetic: " + std::to_string(before.size()) +
                   " positions before the move, those of all " + std::to_string(mesh.n_vertices()) +
                   " vertices expected; a step has them, a file alone has not");
}

// These faces as they are now, ready to be written again.
Patch state_of(const Mesh& mesh, std::vector<int> faces) {
  auto edges = edges_of(mesh, faces);
  return mesh.inverse_of({.faces = std::move(faces),
                          .triangles = {},
                          .labels = {},
                          .halfedges = {},
                          .edges = std::move(edges),
                          .constraints = {}});
}

}  // namespace

RepairOutcome KineticUntangling::repair(Mesh& mesh, const RepairOptions& options) {
  require_before(mesh, options.before);
  RepairOutcome outcome;
  auto& record = outcome.record;
  const Stopwatch detecting;
  const auto tangles = detect(mesh);
  record.inverted = static_cast<int>(tangles.inverted.size());
  record.degenerate = static_cast<int>(tangles.flat.size());
  record.components = inverted_components(mesh, tangles.inverted).count;
  record.detect_ms = detecting.milliseconds();

  const Stopwatch moving;
  Undo undo(mesh);
  KineticFlips flips(undo, options.before);
  flips.run();
  counts_ = flips.counts();
  record.explore_ms = moving.milliseconds();

  const Stopwatch replacing;
  outcome.defect = replace_tangles(undo, options.allow_escaped);
  record.triangulate_ms = replacing.milliseconds();
  if (outcome.defect) return outcome;

  // Regions are described as they were; what follows that takes no memory, and stays.
  const Stopwatch describing;
  record.escaped = count_escaped(mesh, options);
  find_regions(mesh, flips.flipped());
  const Patch result = state_of(mesh, rewritten_faces(flips.flipped()));
  undo.take_back();
  record.regions = describe_regions(mesh);
  record.replaced = record.region_faces();
  mesh.splice(result);
  record.splice_ms = describing.milliseconds();
  return outcome;
}

// As `global` does. Nothing has been spliced if there is no valid mesh.
std::optional<Defect> KineticUntangling::replace_tangles(Undo& undo, bool allow_escaped) {
  const RepairOptions options{.allow_escaped = allow_escaped};
  walk_.run(undo.mesh(), detect(undo.mesh()), replaced_.regions());
  replaced_.start();
  if (auto defect = replaced_.remesh_new(undo.mesh(), options)) return defect;
  if (auto defect = replaced_.remesh_touching(undo.mesh(), options)) return defect;
  for (int region = 0; region < replaced_.regions().count(); ++region)
    undo.splice(replaced_.patch(region).patch);
  return std::nullopt;
}

// Ascending.
std::vector<int> KineticUntangling::rewritten_faces(std::span<const Edge> flipped) {
  std::vector<int> faces;
  for (const auto& [left, right] : flipped) faces.insert(faces.end(), {left, right});
  for (int region = 0; region < replaced_.regions().count(); ++region) {
    const auto& replaced = replaced_.patch(region).patch.faces;
    faces.insert(faces.end(), replaced.begin(), replaced.end());
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

// Faces that were flipped or replaced together belong together.
void KineticUntangling::find_regions(const Mesh& mesh, std::span<const Edge> flipped) {
  const auto faces = rewritten_faces(flipped);
  const auto rank = [&](int face) {
    return static_cast<int>(std::lower_bound(faces.begin(), faces.end(), face) - faces.begin());
  };
  DisjointSets joined(static_cast<int>(faces.size()));
  for (const auto& [left, right] : flipped) joined.join(rank(left), rank(right));
  for (int region = 0; region < replaced_.regions().count(); ++region) {
    const auto& replaced = replaced_.patch(region).patch.faces;
    for (const int face : replaced) joined.join(rank(replaced.front()), rank(face));
  }
  regions_.reset(mesh.n_faces());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const int root = joined.root(static_cast<int>(i));
    regions_.add(faces[i], root == static_cast<int>(i) ? regions_.open() : regions_.set_of(faces[root]));
  }
}

std::vector<RegionRecord> KineticUntangling::describe_regions(const Mesh& mesh) {
  std::vector<RegionRecord> records;
  Hole hole;
  for (int region = 0; region < regions_.count(); ++region) {
    hole.dig(mesh, regions_, region);
    records.push_back(describe_region(mesh, hole));
  }
  for (int region = 0; region < replaced_.regions().count(); ++region) {
    const auto& [patch, replaced] = replaced_.patch(region);
    if (patch.faces.empty()) continue;  // absorbed
    auto& record = records[regions_.set_of(patch.faces.front())];
    record.fallback = true;
    record.retries += replaced.retries;
  }
  std::sort(records.begin(), records.end(), is_seeded_before);
  return records;
}

}  // namespace kinemesh
