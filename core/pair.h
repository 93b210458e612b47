// Two doubles in one register, on any machine: what the sweeps over all faces are made of.
#pragma once

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

inline Pair larger(Pair p, Pair q) {
  return p > q ? p : q;
}

inline Pair smaller(Pair p, Pair q) {
  return p < q ? p : q;
}

}  // namespace kinemesh
