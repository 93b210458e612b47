#include "core/sweep/face_sweep_lanes.h"

namespace kinemesh {
namespace {

struct Two {
  static constexpr int faces = 2;
  static constexpr int face_in[] = {0, 1};
  using Doubles = Pair;
  using Mask = long long __attribute__((vector_size(16)));

  static Doubles points(const double* positions, const int* corner) { return point(positions, *corner); }
  static Doubles swapped(Doubles p) { return __builtin_shufflevector(p, p, 1, 0); }
  static Doubles firsts(Doubles p, Doubles q) { return __builtin_shufflevector(p, q, 0, 2); }
  static Doubles seconds(Doubles p, Doubles q) { return __builtin_shufflevector(p, q, 1, 3); }
  static bool all(Mask m) { return m[0] & m[1]; }
  static double smallest(Doubles p) { return p[0] < p[1] ? p[0] : p[1]; }
};

}  // namespace

SweepKernel* sweep_by_two(Look look) {
  return sweep_with<Two>(look);
}

}  // namespace kinemesh
