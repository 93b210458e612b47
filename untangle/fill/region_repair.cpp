#include "untangle/fill/region_repair.h"

#include <stdexcept>
#include <utility>

#include "core/base/parallel.h"
#include "untangle/fill/new_faces.h"
#include "untangle/fill/records.h"

namespace kinemesh {
namespace {

// After so many rings of neighbours the whole mesh is taken.
constexpr int max_rings = 4;

void clear(RegionPatch& work) {
  work.patch.faces.clear();
  work.patch.triangles.clear();
  work.patch.labels.clear();
  work.patch.across.clear();
  work.patch.lines.clear();
  work.record = {};
}

}  // namespace

void RegionRepair::start() {
  n_prepared_ = 0;
  touching_.clear();
}

void RegionRepair::prepare_new() {
  if (regions_.count() > static_cast<int>(patches_.size())) patches_.resize(regions_.count());
  for (; n_prepared_ < regions_.count(); ++n_prepared_) clear(patches_[n_prepared_]);
}

void RegionRepair::take_new(const Mesh& mesh) {
  first_taken_ = n_prepared_;
  prepare_new();
  const std::size_t n = n_prepared_ - first_taken_;
  attempts_.assign(n, {});
  if (n > holes_.size()) holes_.resize(n);
  for (std::size_t i = 0; i < n; ++i) holes_[i].dig(mesh, regions_, first_taken_ + static_cast<int>(i));
}

std::optional<Defect> RegionRepair::remesh_taken(const Mesh& mesh, const RepairOptions& options) {
  const int n = static_cast<int>(attempts_.size());
  parallel_parts(n, grain::regions, [&](int, int begin, int end) {
    for (int i = begin; i < end; ++i) attempts_[i] = attempt(mesh, options, first_taken_ + i, holes_[i]);
  });
  for (int i = 0; i < n; ++i) {
    if (attempts_[i].defect) return std::move(attempts_[i].defect);
    if (!attempts_[i].is_simple) touching_.push_back(first_taken_ + i);
  }
  return std::nullopt;
}

std::optional<Defect> RegionRepair::remesh_new(const Mesh& mesh, const RepairOptions& options) {
  take_new(mesh);
  return remesh_taken(mesh, options);
}

std::optional<Defect> RegionRepair::remesh_touching(const Mesh& mesh, const RepairOptions& options) {
  for (const int region : touching_) {
    if (auto defect = remesh(mesh, options, region)) return defect;
  }
  return std::nullopt;
}

std::optional<Defect> RegionRepair::remesh(const Mesh& mesh, const RepairOptions& options, int region) {
  prepare_new();
  if (regions_.faces(region).empty()) return std::nullopt;  // absorbed
  Hole hole;
  hole.dig(mesh, regions_, region);
  auto result = attempt(mesh, options, region, hole);
  while (!result.is_simple) {
    if (static_cast<int>(regions_.faces(region).size()) == mesh.n_faces())
      throw std::logic_error("the border of the padded mesh is not convex");
    ++patches_[region].record.retries;
    enlarge(mesh, region);
    hole.dig(mesh, regions_, region);
    result = attempt(mesh, options, region, hole);
  }
  return std::move(result.defect);
}

// Reads the hole and its mesh only, and writes the region's patch only.
RegionRepair::Attempt RegionRepair::attempt(const Mesh& mesh, const RepairOptions& options, int region,
                                            const Hole& hole) {
  auto& worker = workers_.local();
  auto& work = patches_[region];
  const int retries = work.record.retries;
  work.record = describe_region(mesh, hole);
  work.record.retries = retries;
  if (options.retain && remesh_rest(mesh, options, region, hole)) return {};
  const auto result = worker.mesher.run(mesh, hole);
  if (result == RegionMesher::Result::NotSimple) return {.is_simple = false, .defect = {}};
  if (result == RegionMesher::Result::NoMesh) return {.is_simple = true, .defect = worker.mesher.defect()};
  return {.is_simple = true,
          .defect =
              worker.finisher.run(mesh, hole, worker.mesher.new_faces(), options.allow_escaped, work.patch)};
}

// False where not all goes well: then there is more to replace, or a reason that the whole region tells.
bool RegionRepair::remesh_rest(const Mesh& mesh, const RepairOptions& options, int region, const Hole& hole) {
  auto& worker = workers_.local();
  const auto& retention = worker.retention;
  if (!worker.retention.run(mesh, hole.faces)) return false;
  worker.rest.dig(mesh, retention.rest(), 0);
  if (worker.mesher.run(mesh, worker.rest) != RegionMesher::Result::Done) return false;
  if (!fit(worker.mesher.new_faces(), worker.rest)) return false;
  if (worker.finisher.run(mesh, worker.rest, worker.mesher.new_faces(), options.allow_escaped,
                          patches_[region].patch))
    return false;
  patches_[region].record.kept = retention.kept();
  return true;
}

void RegionRepair::enlarge(const Mesh& mesh, int region) {
  if (patches_[region].record.retries > max_rings) {
    for (const Face face : mesh.faces()) take(face, region);
  } else {
    const auto faces = regions_.faces(region);  // a copy: the set grows
    for (const Face face : faces) {
      for (const Side side : mesh.sides(face)) {
        const Face across = mesh.face_across(side);
        if (across != none) take(across, region);
      }
    }
  }
  regions_.sort(region);
}

void RegionRepair::take(Face face, int region) {
  const int other = regions_.set_of(face);
  if (other == region) return;
  if (other == none) {
    regions_.add(face, region);
    return;
  }
  regions_.absorb(region, other);
  patches_[region].record.retries += patches_[other].record.retries;
  clear(patches_[other]);
}

}  // namespace kinemesh
