// From sets of faces to patches, with the safety net for borders that degenerate positions have made touch
// something.
#pragma once

#include <optional>
#include <vector>

#include "core/defect.h"
#include "core/mesh.h"
#include "untangle/face_sets.h"
#include "untangle/region_mesher.h"
#include "untangle/retention.h"
#include "untangle/strategy.h"

namespace kinemesh {

// A region on its way to the splice.
struct RegionPatch {
  Patch patch;            // empty where the region was absorbed by another
  std::vector<int> kept;  // faces of the region that stay
  int retries = 0;        // enlargements
};

// The regions of a global walk, re-meshed one by one. Changes no mesh.
class RegionRepair {
 public:
  FaceSets& regions() { return regions_; }
  const FaceSets& regions() const { return regions_; }

  // To be called once the regions are complete.
  void start() { patches_.assign(regions_.count(), {}); }

  // Re-meshes one region. While its border is not simple, it is enlarged by the faces across its border and
  // the regions they belong to, in the end by all faces: a retry, which is counted. Returns why there is no
  // mesh, if there is none.
  [[nodiscard]] std::optional<Defect> remesh(const Mesh& mesh, const RepairOptions& options, int region);

  const RegionPatch& patch(int region) const { return patches_[region]; }

 private:
  bool remesh_rest(const Mesh& mesh, const RepairOptions& options, int region);
  void enlarge(const Mesh& mesh, int region);
  void take(int face, int region);

  FaceSets regions_;
  RegionMesher mesher_;
  Retention retention_;
  std::vector<RegionPatch> patches_;  // per region
};

}  // namespace kinemesh
