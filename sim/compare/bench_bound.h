// Local explorations of a tangled mesh, one by one, beside what bounds their time [Agarwal 2008, Theorem
// 4.4].
#pragma once

#include <cstdint>
#include <vector>

#include "kinemesh/mesh.h"

namespace kinemesh {

// Of one seed, whose exploration ended with the region R*. d and k are found in rounded arithmetic: nothing
// depends on them.
struct BoundSample {
  UserFace seed;                  // none in padding
  int upright = 0, inverted = 0;  // n+, n-: faces of R*
  int components = 0;             // delta: inverted components in R*
  int depth = 0;                  // d: faces of R* over one point, at most
  std::int64_t crossings = 0;     // of edges of upright faces of R*, without those at common ends
  std::int64_t complexity = 0;    // k: their crossings and vertices
  int rounds = 0;                 // of growing
  double explore_us = 0.0;        // the shortest of three explorations

  int faces() const { return upright + inverted; }
  double bound() const;  // n- + (n+ max(d, delta) + k) ln n
};

// From the first face of inverted components, evenly chosen where there are more than `most`. Leaves out
// explorations that degenerate positions end. Deterministic but for the times.
std::vector<BoundSample> sample_bound(const Mesh& tangled, int most);

}  // namespace kinemesh
