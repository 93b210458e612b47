// The global repair where it pays, a new triangulation where it does not.
#pragma once

#include "untangle/strategies/global.h"
#include "untangle/strategies/remesh.h"

namespace kinemesh {

// As `global`, unless most of the mesh would be replaced; then as `remesh`. Which it will be shows early: so
// many tangled faces cover most of the mesh, and a walk that has come too far is given up. Valid meshes and
// defects are those of the strategy it turns to. Deterministic: only counts decide.
class AutomaticRepair : public Strategy {
 public:
  std::string_view name() const override { return "auto"; }
  [[nodiscard]] RepairOutcome repair(Mesh& mesh, const Move& move) override;

 private:
  GlobalUntangling global_;
  FullRemesh remesh_;
};

}  // namespace kinemesh
