#include "core/mesh/winding.h"

#include <limits>

namespace kinemesh {
namespace {

constexpr int unknown = std::numeric_limits<int>::min();

}  // namespace

std::vector<int> winding_numbers(const Triangulation& triangulation, std::span<const Edge> edges) {
  const int n = static_cast<int>(triangulation.triangles.size());
  std::vector<int> winding(n, unknown);
  std::vector<int> pending;

  // What crossing side k of triangle t inward, from right to left of it, adds.
  const auto step_in = [&](int t, int k) {
    const int e = triangulation.edges[t][k];
    if (e < 0 || e >= static_cast<int>(edges.size())) return 0;
    return edges[e][0] == triangulation.triangles[t][k] ? 1 : -1;
  };
  const auto visit = [&](int t, int number) {
    if (winding[t] != unknown) return;
    winding[t] = number;
    pending.push_back(t);
  };

  for (int t = 0; t < n; ++t) {
    for (int k = 0; k < 3; ++k) {
      if (triangulation.neighbours[t][k] == none) visit(t, step_in(t, k));
    }
  }
  while (!pending.empty()) {
    const int t = pending.back();
    pending.pop_back();
    for (int k = 0; k < 3; ++k) {
      const int across = triangulation.neighbours[t][k];
      if (across != none) visit(across, winding[t] - step_in(t, k));
    }
  }
  return winding;
}

}  // namespace kinemesh
