// How long a step would take if everything were meshed anew, measured on copies of a run's own meshes.
#pragma once

#include <optional>
#include <vector>

#include "core/mesh.h"
#include "sim/stepper.h"

namespace kinemesh::cli {

class RemeshProbe {
 public:
  // Chooses the steps of a run of so many that are measured: a few, evenly spread, the last among them.
  explicit RemeshProbe(int steps);

  // Re-meshes a copy of `mesh` if `record` is of a chosen step that was accepted.
  void sample(const StepRecord& record, const Mesh& mesh);

  // Median over the samples of moving, detecting, meshing and writing back; nothing without samples.
  std::optional<double> step_ms() const;

 private:
  int steps_;
  std::vector<double> step_ms_;
};

}  // namespace kinemesh::cli
