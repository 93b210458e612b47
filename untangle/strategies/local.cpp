#include "kinemesh/local.h"

#include <algorithm>
#include <utility>

#include "core/base/stopwatch.h"
#include "core/mesh/around.h"
#include "core/mesh/undo.h"
#include "kinemesh/error.h"
#include "kinemesh/predicates.h"
#include "untangle/explore/local_exploration.h"
#include "untangle/fill/doubled_edges.h"
#include "untangle/fill/overlapping_mesher.h"
#include "untangle/fill/records.h"
#include "untangle/fill/region_mesher.h"
#include "untangle/fill/region_repair.h"
#include "untangle/fill/retention.h"
#include "untangle/walk/detect.h"
#include "untangle/walk/global_walk.h"

namespace kinemesh {
namespace {

Orientation turn(const Mesh& mesh, Face face) {
  const auto [a, b, c] = mesh.corners(face);
  return orientation(a, b, c);
}

// Nothing has been done, but time has been taken.
RepairRecord without_counts(const RepairRecord& record) {
  RepairRecord times;
  times.detect_ms = record.detect_ms;
  times.explore_ms = record.explore_ms;
  times.triangulate_ms = record.triangulate_ms;
  times.splice_ms = record.splice_ms;
  return times;
}

std::vector<Face> seeds_by_user_number(const Mesh& mesh, const Tangles& tangles) {
  auto seeds = tangles.inverted;
  seeds.insert(seeds.end(), tangles.flat.begin(), tangles.flat.end());
  const auto key = [&](Face f) { return std::tuple(mesh.is_padding(f), mesh.user_face(f), f); };
  std::sort(seeds.begin(), seeds.end(), [&](Face f, Face g) { return key(f) < key(g); });
  return seeds;
}

}  // namespace

class LocalUntangling::Worker {
 public:
  RepairOutcome repair_seeds(Mesh& mesh, std::span<const Face> seeds, const RepairOptions& options);

 private:
  struct Region {
    RegionRecord record;
    Patch patch;
    int doubled_edges = 0;
    std::optional<Defect> defect;
  };

  Region untangle(const Mesh& mesh, Face seed, const RepairOptions& options, RepairRecord& times);
  std::optional<Region> minimum_region(const Mesh& mesh, Face seed, const RepairOptions& options,
                                       RepairRecord& times);
  Region piece_of_global_walk(const Mesh& mesh, Face seed, const RepairOptions& options, RepairRecord& times);
  bool remesh(const Mesh& mesh, const LocalExploration& exploration, const RepairOptions& options,
              Region& region);
  bool remesh_rest(const Mesh& mesh, const RepairOptions& options, Region& region);
  void finish_region(const Mesh& mesh, const FaceSets& sets, const Hole& hole, const RepairOptions& options,
                     NewFaces faces, Region& region);

  FaceSets sets_;  // the region at hand
  Hole hole_, rest_;
  RegionMesher mesher_;
  Finisher finisher_;
  Retention retention_;
  RegionRepair pieces_;  // of the global walk of this repair, once one was needed
  bool has_walked_ = false;
};

LocalUntangling::LocalUntangling() : worker_(std::make_unique<Worker>()) {}
LocalUntangling::~LocalUntangling() = default;
LocalUntangling::LocalUntangling(LocalUntangling&&) noexcept = default;
LocalUntangling& LocalUntangling::operator=(LocalUntangling&&) noexcept = default;

RepairOutcome LocalUntangling::repair(Mesh& mesh, const Move& move) {
  RepairRecord found;
  const auto tangles = detect(mesh, move, found);
  const auto components = inverted_components(mesh, tangles.inverted);
  auto outcome = repair_seeds(mesh, seeds_by_user_number(mesh, tangles), move.options());
  outcome.record.inverted = found.inverted;
  outcome.record.degenerate = found.degenerate;
  outcome.record.components = components.count;
  outcome.record.doubled_edges = 0;  // an upright mesh has none
  outcome.record.detect_ms += found.detect_ms;
  return outcome;
}

RepairOutcome LocalUntangling::repair_seeds(Mesh& mesh, std::span<const Face> seeds,
                                            const RepairOptions& options) {
  return worker_->repair_seeds(mesh, seeds, options);
}

RepairOutcome LocalUntangling::Worker::repair_seeds(Mesh& mesh, std::span<const Face> seeds,
                                                    const RepairOptions& options) {
  for (const Face seed : seeds) {
    if (seed < 0 || seed >= mesh.n_faces()) throw InputError("there is no face " + std::to_string(seed));
    if (!is_upright(mesh, seed)) continue;
    throw InputError("face " + std::to_string(mesh.user_face(seed)) +
                     " is upright, an inverted or flat seed expected");
  }
  RepairOutcome outcome;
  auto& record = outcome.record;
  Undo undo(mesh);
  has_walked_ = false;
  for (const Face seed : seeds) {
    if (is_upright(mesh, seed)) continue;
    auto region = untangle(mesh, seed, options, record);
    if (region.defect) return {without_counts(record), std::move(region.defect)};
    const Stopwatch splicing;
    undo.splice(region.patch);
    record.splice_ms += splicing.milliseconds();
    record.inverted += region.record.inverted;
    record.degenerate += region.record.degenerate;
    record.components += region.record.components;
    record.replaced += static_cast<int>(region.patch.faces.size());
    record.doubled_edges += region.doubled_edges;
    record.regions.push_back(std::move(region.record));
  }
  undo.keep();
  record.escaped = count_escaped(mesh, options);
  return outcome;
}

LocalUntangling::Worker::Region LocalUntangling::Worker::untangle(const Mesh& mesh, Face seed,
                                                                  const RepairOptions& options,
                                                                  RepairRecord& times) {
  if (turn(mesh, seed) == Orientation::Clockwise) {
    if (auto region = minimum_region(mesh, seed, options, times)) return std::move(*region);
  }
  return piece_of_global_walk(mesh, seed, options, times);
}

// Nothing where degenerate positions are in the way, or labels that other tangles keep from fitting.
std::optional<LocalUntangling::Worker::Region> LocalUntangling::Worker::minimum_region(
    const Mesh& mesh, Face seed, const RepairOptions& options, RepairRecord& times) {
  const Stopwatch exploring;
  LocalExploration exploration(mesh);
  const bool found = exploration.run(seed);
  times.explore_ms += exploring.milliseconds();
  if (!found) return std::nullopt;

  const Stopwatch triangulating;
  sets_.reset(mesh.n_faces());
  const int set = sets_.open();
  for (const Face face : exploration.faces()) sets_.add(face, set);

  Region region;
  hole_.dig(mesh, sets_, set);
  region.record = describe_region(mesh, hole_);
  region.record.seed = mesh.user_face(seed);
  region.record.explored = exploration.explored();
  region.record.gamma_first_stable = exploration.gamma_first_stable();
  region.record.gamma = exploration.gamma();
  region.record.rounds = exploration.rounds();
  region.record.grown = exploration.grown();
  const bool is_general = remesh(mesh, exploration, options, region);
  times.triangulate_ms += triangulating.milliseconds();
  if (!is_general || region.defect) return std::nullopt;
  return region;
}

// False where degenerate positions are in the way.
bool LocalUntangling::Worker::remesh(const Mesh& mesh, const LocalExploration& exploration,
                                     const RepairOptions& options, Region& region) {
  const auto result = mesher_.run(mesh, hole_);
  if (result == RegionMesher::Result::NoMesh) {
    region.defect = mesher_.defect();
  } else if (result == RegionMesher::Result::Done) {
    auto faces = std::move(mesher_.new_faces());
    if (!options.retain || !remesh_rest(mesh, options, region))
      finish_region(mesh, sets_, hole_, options, std::move(faces), region);
  } else {
    auto faces = mesh_overlapping(mesh, sets_, 0, exploration.cells());
    if (!faces) return false;
    region.record.self_overlap = true;
    finish_region(mesh, sets_, hole_, options, std::move(*faces), region);
  }
  return true;
}

// False where not all goes well: then there is more to replace, or a reason that the whole region tells.
bool LocalUntangling::Worker::remesh_rest(const Mesh& mesh, const RepairOptions& options, Region& region) {
  if (!retention_.run(mesh, hole_.faces)) return false;
  rest_.dig(mesh, retention_.rest(), 0);
  if (mesher_.run(mesh, rest_) != RegionMesher::Result::Done || !fit(mesher_.new_faces(), rest_))
    return false;
  finish_region(mesh, retention_.rest(), rest_, options, std::move(mesher_.new_faces()), region);
  if (!region.defect) region.record.kept = retention_.kept();
  return !region.defect;
}

void LocalUntangling::Worker::finish_region(const Mesh& mesh, const FaceSets& sets, const Hole& hole,
                                            const RepairOptions& options, NewFaces faces, Region& region) {
  region.doubled_edges = avoid_doubled_edges(mesh, sets, 0, faces);
  region.defect = finisher_.run(mesh, hole, faces, options.allow_escaped, region.patch);
}

// One walk serves all seeds: each region that is replaced lies in one piece, whose border stays.
LocalUntangling::Worker::Region LocalUntangling::Worker::piece_of_global_walk(const Mesh& mesh, Face seed,
                                                                              const RepairOptions& options,
                                                                              RepairRecord& times) {
  const Stopwatch exploring;
  if (!has_walked_) {
    GlobalWalk().run(mesh, detect(mesh), pieces_.regions());
    pieces_.start();
    has_walked_ = true;
  }
  times.explore_ms += exploring.milliseconds();

  const Stopwatch triangulating;
  const int piece = pieces_.regions().set_of(seed);
  Region region;
  region.defect = pieces_.remesh(mesh, options, piece);
  if (!region.defect) {
    auto& work = pieces_.patch(piece);
    region.record = std::move(work.record);
    region.record.seed = mesh.user_face(seed);
    region.record.fallback = true;
    region.patch = std::move(work.patch);
  }
  times.triangulate_ms += triangulating.milliseconds();
  return region;
}

}  // namespace kinemesh
