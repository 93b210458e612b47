#include "untangle/region_repair.h"

#include <stdexcept>
#include <utility>

#include "core/parallel.h"
#include "untangle/new_faces.h"
#include "untangle/records.h"

namespace kinemesh {
namespace {

constexpr int grain = 16;  // regions that are worth a task

// After so many rings of neighbours the whole mesh is taken.
constexpr int max_rings = 4;

void clear(RegionPatch& work) {
  work.patch.faces.clear();
  work.patch.triangles.clear();
  work.patch.labels.clear();
  work.patch.halfedges.clear();
  work.patch.edges.clear();
  work.patch.constraints.clear();
  work.patch.outgoing.clear();
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

std::optional<Defect> RegionRepair::remesh_new(const Mesh& mesh, const RepairOptions& options) {
  const int first = n_prepared_;
  prepare_new();
  attempts_.assign(n_prepared_ - first, {});
  parallel_parts(n_prepared_ - first, grain, [&](int, int begin, int end) {
    for (int i = begin; i < end; ++i) attempts_[i] = attempt(mesh, options, first + i);
  });
  for (int region = first; region < n_prepared_; ++region) {
    auto& result = attempts_[region - first];
    if (result.defect) return std::move(result.defect);
    if (!result.is_simple) touching_.push_back(region);
  }
  return std::nullopt;
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
  auto result = attempt(mesh, options, region);
  while (!result.is_simple) {
    if (static_cast<int>(regions_.faces(region).size()) == mesh.n_faces())
      throw std::logic_error("the border of the padded mesh is not convex");
    ++patches_[region].record.retries;
    enlarge(mesh, region);
    result = attempt(mesh, options, region);
  }
  return std::move(result.defect);
}

// Reads the region and its mesh only, and writes its patch only.
RegionRepair::Attempt RegionRepair::attempt(const Mesh& mesh, const RepairOptions& options, int region) {
  auto& worker = workers_.local();
  auto& work = patches_[region];
  const int retries = work.record.retries;
  worker.hole.dig(mesh, regions_, region);
  work.record = describe_region(mesh, worker.hole);
  work.record.retries = retries;
  if (options.retain && remesh_rest(worker, mesh, options, region)) return {};
  const auto result = worker.mesher.run(mesh, worker.hole);
  if (result == RegionMesher::Result::NotSimple) return {.is_simple = false, .defect = {}};
  if (result == RegionMesher::Result::NoMesh) return {.is_simple = true, .defect = worker.mesher.defect()};
  return {.is_simple = true,
          .defect = worker.finisher.run(mesh, worker.hole, worker.mesher.new_faces(), options.allow_escaped,
                                        work.patch)};
}

// False where not all goes well: then there is more to replace, or a reason that the whole region tells.
bool RegionRepair::remesh_rest(Worker& worker, const Mesh& mesh, const RepairOptions& options, int region) {
  const auto& retention = worker.retention;
  if (!worker.retention.run(mesh, regions_, region)) return false;
  worker.rest.dig(mesh, retention.rest(), 0);
  if (worker.mesher.run(mesh, worker.rest) != RegionMesher::Result::Done) return false;
  if (worker.finisher.run(mesh, worker.rest, worker.mesher.new_faces(), options.allow_escaped,
                          patches_[region].patch))
    return false;
  patches_[region].record.kept = retention.kept();
  return true;
}

void RegionRepair::enlarge(const Mesh& mesh, int region) {
  if (patches_[region].record.retries > max_rings) {
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

void RegionRepair::take(int face, int region) {
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
