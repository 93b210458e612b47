// The plain alternative: forget the connectivity, triangulate all vertices anew.
#pragma once

#include "kinemesh/strategy.h"
#include "untangle/fill/region_mesher.h"

namespace kinemesh {

// CGAL's constrained Delaunay triangulation of everything, spatially sorted, at every call, tangled or not.
// Fails where no valid mesh exists, and only there. Its record holds one region, the whole mesh.
class FullRemesh : public Strategy {
 public:
  std::string_view name() const override { return "remesh"; }
  // triangulate_ms is CGAL's triangulation alone; what it takes to make it our mesh is in splice_ms.
  [[nodiscard]] RepairOutcome repair(Mesh& mesh, const Move& move) override;

 private:
  FaceSets everything_;
  Hole hole_;
  RegionMesher mesher_;
  Finisher finisher_;
};

}  // namespace kinemesh
