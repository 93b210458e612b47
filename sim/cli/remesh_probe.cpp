#include "sim/cli/remesh_probe.h"

#include <algorithm>
#include <chrono>

#include "untangle/strategy.h"

namespace kinemesh::cli {
namespace {

constexpr int n_samples = 4;

double repair_ms(Strategy& strategy, Mesh& mesh) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  if (!strategy.repair(mesh, {})) return 0.0;
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

RemeshProbe::RemeshProbe(int steps) : steps_(steps) {}

void RemeshProbe::sample(const StepRecord& record, const Mesh& mesh) {
  const int stride = std::max(1, steps_ / n_samples);
  const bool is_chosen = (steps_ - record.step) % stride == 0 && (steps_ - record.step) / stride < n_samples;
  if (!record.accepted || !is_chosen) return;
  Mesh copy = mesh;
  const double ms = repair_ms(*make_strategy("remesh"), copy);
  if (ms > 0.0) step_ms_.push_back(record.move_ms + ms);
}

std::optional<double> RemeshProbe::step_ms() const {
  if (step_ms_.empty()) return std::nullopt;
  std::vector<double> sorted = step_ms_;
  std::sort(sorted.begin(), sorted.end());
  return sorted[sorted.size() / 2];
}

}  // namespace kinemesh::cli
