// Seeded random tangled meshes of all degrees of hopelessness.
#pragma once

#include <cstdint>
#include <random>

#include "kinemesh/mesh_data.h"

namespace kinemesh::test {

// Whole and double numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double from, double to) { return from + (to - from) * uniform(); }
  Point in_square() { return {uniform(), uniform()}; }

 private:
  std::mt19937_64 engine_;
};

enum class Tangling { Jitter, JitterSome, Exchange, Fold, Throw, Twist, ExchangeAndJitter };
inline constexpr int n_tanglings = 7;

// A Delaunay mesh of the unit square whose inner vertices have been moved, at random: a little or far, all or
// some, exchanged, folded over lines, thrown anywhere, or twisted. The border is still and nothing leaves the
// square. Pre: n_vertices >= 5.
MeshData random_tangle(std::uint64_t seed, Tangling tangling, int n_vertices);

// The same with 5 to 60 vertices, mostly few, and any tangling.
MeshData random_tangle(std::uint64_t seed);

// The same with all inner vertices within some ulps of the nodes of a coarse grid: in general position, but
// many predicates are nearly 0.
MeshData nearly_degenerate_tangle(std::uint64_t seed);

}  // namespace kinemesh::test
