// Global untangling: every tangle of the mesh at once, each replaced within the region it covers.
#pragma once

#include "untangle/detect.h"
#include "untangle/global_walk.h"
#include "untangle/region_repair.h"
#include "untangle/strategy.h"

namespace kinemesh {

// Detect, walk, re-mesh each region, and only then splice: whatever fails leaves the mesh as it was. Faces
// outside the regions R* = phi(I)* stay; a valid mesh exists and is found unless constrained edges touch,
// vertices coincide, or a vertex has left the padded mesh [Agarwal 2008, §5 and Lemma 3.3].
class GlobalUntangling : public Strategy {
 public:
  std::string_view name() const override { return "global"; }
  [[nodiscard]] RepairOutcome repair(Mesh& mesh, const RepairOptions& options) override;

 private:
  std::optional<Defect> remesh(const Mesh& mesh, const RepairOptions& options);
  void describe(const Mesh& mesh, const Tangles& tangles, RepairRecord& record) const;

  GlobalWalk walk_;
  RegionRepair repair_;
};

}  // namespace kinemesh
