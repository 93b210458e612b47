#include "sim/cli/remesh_probe.h"

#include <algorithm>

#include "core/base/stopwatch.h"

namespace kinemesh::cli {
namespace {

constexpr int n_samples = 4;

std::optional<double> repair_ms(Strategy& strategy, Mesh& mesh) {
  const Stopwatch working;
  if (!strategy.repair(mesh, {})) return std::nullopt;
  return working.milliseconds();
}

}  // namespace

RemeshProbe::RemeshProbe(int steps) : steps_(steps), strategy_(make_strategy("remesh")) {}

bool RemeshProbe::is_chosen(int step) const {
  const int left = steps_ - step, stride = std::max(1, steps_ / n_samples);
  return left >= 0 && left % stride == 0 && left / stride < n_samples;
}

void RemeshProbe::sample(const StepRecord& record, const Mesh& mesh) {
  if (!record.accepted || !is_chosen(record.step)) return;
  Mesh copy = mesh;
  if (const auto ms = repair_ms(*strategy_, copy)) step_ms_.push_back(record.move_ms + *ms);
}

std::optional<double> RemeshProbe::step_ms() const {
  if (step_ms_.empty()) return std::nullopt;
  std::vector<double> sorted = step_ms_;
  std::sort(sorted.begin(), sorted.end());
  return sorted[(sorted.size() - 1) / 2];
}

}  // namespace kinemesh::cli
