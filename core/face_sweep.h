// What sweeps over all faces are made of: two doubles in one register, on any machine, and positions that are
// on their way from memory before they are asked for.
#pragma once

#include <algorithm>
#include <span>

#include "core/types.h"

namespace kinemesh {

using Pair = double __attribute__((vector_size(16)));
using PairMask = long long __attribute__((vector_size(16)));  // of each double: -1 true, 0 false

inline Pair difference(const Point& a, const Point& b) {
  return Pair{a.x, a.y} - Pair{b.x, b.y};
}

inline Pair swapped(Pair p) {
  return __builtin_shufflevector(p, p, 1, 0);
}

inline Pair firsts(Pair p, Pair q) {
  return __builtin_shufflevector(p, q, 0, 2);
}

inline Pair seconds(Pair p, Pair q) {
  return __builtin_shufflevector(p, q, 1, 3);
}

inline Pair magnitude(Pair p) {
  return p < 0.0 ? -p : p;
}

inline Pair smaller(Pair p, Pair q) {
  return p < q ? p : q;
}

// Asks for the corners of a face that comes a little after this one. The first follows by itself, since faces
// are in the order of their lowest vertex.
inline void fetch_ahead(std::span<const Triangle> triangles, std::span<const Point> positions, int face) {
  constexpr std::size_t ahead = 64;
  const auto& t = triangles[std::min(face + ahead, triangles.size() - 1)];
  __builtin_prefetch(&positions[t[1]]);
  __builtin_prefetch(&positions[t[2]]);
}

}  // namespace kinemesh
