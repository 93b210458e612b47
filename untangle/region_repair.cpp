#include "untangle/region_repair.h"

#include <stdexcept>

#include "untangle/new_faces.h"

namespace kinemesh {
namespace {

// After so many rings of neighbours the whole mesh is taken.
constexpr int max_rings = 4;

}  // namespace

std::optional<Defect> RegionRepair::remesh(const Mesh& mesh, const RepairOptions& options, int region) {
  if (regions_.faces(region).empty()) return std::nullopt;  // absorbed
  auto& work = patches_[region];
  auto result = mesher_.run(mesh, regions_, region);
  while (result == RegionMesher::Result::NotSimple) {
    if (static_cast<int>(regions_.faces(region).size()) == mesh.n_faces())
      throw std::logic_error("the border of the padded mesh is not convex");
    ++work.retries;
    enlarge(mesh, region);
    result = mesher_.run(mesh, regions_, region);
  }
  if (result == RegionMesher::Result::NoMesh) return mesher_.defect();
  auto finished = finish(mesh, regions_, region, std::move(mesher_.new_faces()), options.allow_escaped);
  if (finished.defect) return finished.defect;
  work.patch = std::move(finished.patch);
  work.border_edges = mesher_.border_edges();
  work.centre = mesher_.centre();
  return std::nullopt;
}

void RegionRepair::enlarge(const Mesh& mesh, int region) {
  if (patches_[region].retries > max_rings) {
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
  patches_[region].retries += patches_[other].retries;
  patches_[other] = {};
}

}  // namespace kinemesh
