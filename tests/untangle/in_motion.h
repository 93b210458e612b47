// What must hold when a mesh is untangled by following its vertices through the step.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "kinemesh/mesh.h"

namespace kinemesh::test {

// Summed over repairs.
struct MotionTotals {
  int repaired = 0, failed = 0;
  int events = 0, flips = 0, stuck = 0;
  int replacements = 0;  // repairs that needed some
};

// `kinetic` on a copy: success just where `global` has it, the contract of all repairs (properties.h), each
// tangle in a region, and a failure without traces. What is wrong, in a sentence, or nothing.
std::string check_in_motion(const Mesh& moved, std::span<const Point> before, MotionTotals& totals);

// The same for a random tangle, a lattice and a polyomino (random_tangles.h), and what they are.
std::string check_tangles_in_motion(std::uint64_t seed);

}  // namespace kinemesh::test
