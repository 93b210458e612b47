// How long a step would take if everything were meshed anew, measured on copies of a run's own meshes.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/stepper.h"
#include "kinemesh/strategy.h"

namespace kinemesh::cli {

class RemeshProbe {
 public:
  // Chooses the steps of a run of so many that are measured: a few, evenly spread, the last among them.
  explicit RemeshProbe(int steps = 0);

  // Re-meshes a copy of `mesh` if `record` is of a chosen step that was accepted.
  void sample(const StepRecord& record, const Mesh& mesh);

  // Median over the samples of moving, detecting, meshing and writing back; nothing without samples.
  std::optional<double> step_ms() const;

 private:
  bool is_chosen(int step) const;

  int steps_;
  std::unique_ptr<Strategy> strategy_;  // one for all samples: its scratch memory is warm, as in a run
  std::vector<double> step_ms_;
};

}  // namespace kinemesh::cli
