// Global untangling: every tangle of the mesh at once, each replaced within the region it covers.
#pragma once

#include "untangle/detect.h"
#include "untangle/face_sets.h"
#include "untangle/region_mesher.h"
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
  // A region from the walk to the splice.
  struct Work {
    Patch patch;  // empty where the region was absorbed by another
    int border_edges = 0;
    int retries = 0;
    int escaped = 0;
    Point centre{0.0, 0.0};
  };

  std::optional<Defect> remesh_all(const Mesh& mesh, const RepairOptions& options);
  std::optional<Defect> remesh(const Mesh& mesh, const RepairOptions& options, int region);
  void enlarge(const Mesh& mesh, int region);
  void take(int face, int region);
  void describe(const Mesh& mesh, const Tangles& tangles, RepairRecord& record) const;

  // Scratch memory, kept from step to step.
  FaceSets regions_;
  RegionMesher mesher_;
  std::vector<Work> work_;  // per region
};

}  // namespace kinemesh
