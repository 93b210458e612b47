#include "sim/cli/bench_score.h"

#include <fmt/core.h>

#include <algorithm>

namespace kinemesh::cli {
namespace {

void print_header() {
  fmt::print("{:<8}{:>6}{:>8}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>8}{:>8}{:>8}\n", "", "steps", "repl. %",
             "detect", "explore", "re-mesh", "splice", "quality", "step ms", "rebuild", "angle", "B/vert.");
}

// rebuild_ms: of CGAL's triangulation alone; 0: not known.
void print_score(const std::string& strategy, const Score& s, double rebuild_ms) {
  const int n = s.steps - s.failed;
  const double step_ms = median(s.step);
  fmt::print("{:<8}{:>6}{:>8.3g}{:>9.3g}{:>9.3g}{:>9.3g}{:>9.3g}{:>9.2g}{:>9.4g}{:>8}{:>8.2g}{:>8.0f}\n",
             strategy, n, n > 0 ? 100.0 * s.replaced / n : 0.0, median(s.detect), median(s.explore),
             median(s.triangulate), median(s.splice), median(s.quality), step_ms,
             rebuild_ms > 0.0 && step_ms > 0.0 ? fmt::format("{:.3g}x", rebuild_ms / step_ms) : "-",
             n > 0 ? s.min_angle_deg : 0.0, s.bytes_per_vertex);
  if (s.failed > 0) fmt::print("{:<8}{:>6} without valid mesh\n", "", s.failed);
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void Score::add(const Round& round) {
  const auto& r = round.record.repair;
  ++steps;
  failed += !round.record.accepted;
  if (!round.record.accepted) return;
  replaced += static_cast<double>(r.replaced) / round.mesh.n_faces();
  bytes_per_vertex = static_cast<double>(round.held_bytes) / round.mesh.n_vertices();
  min_angle_deg = std::min(min_angle_deg, round.record.min_angle_deg);
  detect.push_back(r.detect_ms);
  explore.push_back(r.explore_ms);
  triangulate.push_back(r.triangulate_ms);
  splice.push_back(r.splice_ms);
  quality.push_back(r.quality_ms);
  step.push_back(round.record.total_ms - round.record.move_ms);
}

void print_scores(const std::vector<std::string>& strategies, const std::vector<Score>& scores) {
  double rebuild_ms = 0.0;
  for (std::size_t i = 0; i < strategies.size(); ++i)
    if (strategies[i] == "remesh") rebuild_ms = median(scores[i].triangulate);
  print_header();
  for (std::size_t i = 0; i < strategies.size(); ++i) print_score(strategies[i], scores[i], rebuild_ms);
}

}  // namespace kinemesh::cli
