// Global untangling: every tangle of the mesh at once, each replaced within the region it covers.
#pragma once

#include "kinemesh/strategy.h"
#include "untangle/fill/region_repair.h"
#include "untangle/walk/detect.h"
#include "untangle/walk/global_walk.h"

namespace kinemesh {

// Detect, walk and re-mesh the regions in all threads, and only then splice: whatever fails leaves the mesh
// as it was. With more than one thread explore_ms and triangulate_ms overlap. Faces outside the regions
// R* = phi(I)* stay; a valid mesh exists and is found unless constrained edges touch, vertices coincide, or a
// vertex has left the padded mesh [Agarwal 2008, §5 and Lemma 3.3].
class GlobalUntangling : public Strategy {
 public:
  std::string_view name() const override { return "global"; }
  [[nodiscard]] RepairOutcome repair(Mesh& mesh, const Move& move) override;

  // The same, unless more faces than this are tangled or in regions: then nothing, and the mesh is as it was.
  struct Limits {
    int tangled, in_regions;
  };
  [[nodiscard]] std::optional<RepairOutcome> repair_within(const Limits& limits, Mesh& mesh,
                                                           const Move& move);

 private:
  std::optional<Defect> plan(const Mesh& mesh, const RepairOptions& options, RepairRecord& record);
  void splice(Mesh& mesh, RepairRecord& record);
  std::vector<int> regions_by_seed();

  GlobalWalk walk_;
  RegionRepair repair_;
};

}  // namespace kinemesh
