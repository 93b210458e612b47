// Compiled for machines with AVX, or empty.
#include "core/sweep/face_sweep_lanes.h"

#ifdef __AVX__

namespace kinemesh {
namespace {

struct Four {
  static constexpr int faces = 4;
  static constexpr int face_in[] = {0, 2, 1, 3};
  using Doubles = double __attribute__((vector_size(32)));
  using Mask = long long __attribute__((vector_size(32)));

  static Doubles points(const double* positions, const int* corner) {
    return __builtin_shufflevector(point(positions, corner[0]), point(positions, corner[3]), 0, 1, 2, 3);
  }
  static Doubles swapped(Doubles p) { return __builtin_shufflevector(p, p, 1, 0, 3, 2); }
  static Doubles firsts(Doubles p, Doubles q) { return __builtin_shufflevector(p, q, 0, 4, 2, 6); }
  static Doubles seconds(Doubles p, Doubles q) { return __builtin_shufflevector(p, q, 1, 5, 3, 7); }
  static bool all(Mask m) { return m[0] & m[1] & m[2] & m[3]; }
  static double smallest(Doubles p) {
    const double a = p[0] < p[1] ? p[0] : p[1], b = p[2] < p[3] ? p[2] : p[3];
    return a < b ? a : b;
  }
};

}  // namespace

SweepKernel* sweep_by_four(Look look) {
  return __builtin_cpu_supports("avx") ? sweep_with<Four>(look) : nullptr;
}

}  // namespace kinemesh

#else

kinemesh::SweepKernel* kinemesh::sweep_by_four(Look) {
  return nullptr;
}

#endif
