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
  if (options.retain && remesh_rest(mesh, options, region)) return std::nullopt;
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
  return std::nullopt;
}

// False where not all goes well: then there is more to replace, or a reason that the whole region tells.
bool RegionRepair::remesh_rest(const Mesh& mesh, const RepairOptions& options, int region) {
  if (!retention_.run(mesh, regions_, region)) return false;
  if (mesher_.run(mesh, retention_.rest(), 0) != RegionMesher::Result::Done) return false;
  auto finished = finish(mesh, retention_.rest(), 0, std::move(mesher_.new_faces()), options.allow_escaped);
  if (finished.defect) return false;
  patches_[region].patch = std::move(finished.patch);
  patches_[region].kept = retention_.kept();
  return true;
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
