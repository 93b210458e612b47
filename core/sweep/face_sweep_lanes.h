// sweep_by_two and sweep_by_four, written once. For their .cpp files; all of it is local to them.
#pragma once

#include "core/sweep/face_sweep_kernel.h"
#include "kinemesh/detail/orientation_filter.h"

namespace kinemesh {
namespace {

// Of one point each: x and y.
using Pair = double __attribute__((vector_size(16)));

inline Pair point(const double* positions, int vertex) {
  return Pair{positions[2 * vertex], positions[2 * vertex + 1]};
}

constexpr double infinity = __builtin_inf();

// Lanes: a register of `Lanes::faces` doubles. Half as many points fit into one, so faces are taken in two
// halves, p and q; firsts and seconds then have one number of each face: face_in[lane] of those at hand.
template <class Lanes, Look look>
class Sweep {
 public:
  using Doubles = typename Lanes::Doubles;

  // Seen from the last corners: u goes to the first corner, v to the second.
  void take(const double* x, const int* p) {
    constexpr int half = 3 * Lanes::faces / 2;
    const int* const q = p + half;
    const Doubles pc = Lanes::points(x, p + 2), qc = Lanes::points(x, q + 2);
    const Doubles pu = Lanes::points(x, p) - pc, pv = Lanes::points(x, p + 1) - pc;
    const Doubles qu = Lanes::points(x, q) - qc, qv = Lanes::points(x, q + 1) - qc;
    judge(pu * Lanes::swapped(pv), qu * Lanes::swapped(qv));
    if constexpr (look == Look::JudgeAndMeasure)
      measure(sum(pu * pu, qu * qu), sum(pu * pv, qu * qv), sum(pv * pv, qv * qv));
  }

  // Of the last faces: proved upright.
  typename Lanes::Mask upright() const { return upright_; }
  double twice_area() const { return Lanes::smallest(min_cross_); }
  double tangent() const { return Lanes::smallest(min_tangent_); }

 private:
  static Doubles sum(Doubles p, Doubles q) { return Lanes::firsts(p, q) + Lanes::seconds(p, q); }
  static Doubles magnitude(Doubles p) { return p < 0.0 ? -p : p; }
  static Doubles smaller(Doubles p, Doubles q) { return p < q ? p : q; }
  static Doubles larger(Doubles p, Doubles q) { return p > q ? p : q; }

  // As orientation() does.
  void judge(Doubles p, Doubles q) {
    const Doubles l = Lanes::firsts(p, q), r = Lanes::seconds(p, q);
    cross_ = l - r;
    upright_ = cross_ > orientation_bound(magnitude(l), magnitude(r));
  }

  // As tangent_of_smallest_angle does.
  void measure(Doubles uu, Doubles uv, Doubles vv) {
    const Doubles dot = larger(uv, larger(uu, vv) - uv);
    min_cross_ = smaller(cross_, min_cross_);
    min_tangent_ = smaller(cross_ > 0.0 ? cross_ / dot : Doubles{}, min_tangent_);
  }

  Doubles cross_;
  typename Lanes::Mask upright_;
  Doubles min_cross_ = Doubles{} + infinity, min_tangent_ = Doubles{} + infinity;
};

template <class Lanes, Look look>
Sight sweep(const double* positions, const int* triangles, const int* ahead) {
  Sweep<Lanes, look> faces;
  std::uint64_t doubtful = 0;
  for (int f = 0; f < stretch_faces; f += Lanes::faces) {
    // Faces are in the order of their lowest vertex: first corners are mostly near each other, and two faces
    // in a row mostly share a side.
    for (int i = f; i < f + Lanes::faces; i += 2) {
      __builtin_prefetch(positions + 2 * ahead[3 * i + 1]);
      __builtin_prefetch(positions + 2 * ahead[3 * i + 2]);
    }
    faces.take(positions, triangles + 3 * f);
    if (Lanes::all(faces.upright())) [[likely]]
      continue;
    for (int lane = 0; lane < Lanes::faces; ++lane)
      doubtful |= std::uint64_t{faces.upright()[lane] == 0} << (f + Lanes::face_in[lane]);
  }
  return {doubtful, faces.twice_area(), faces.tangent()};
}

template <class Lanes>
SweepKernel* sweep_with(Look look) {
  return look == Look::Judge ? sweep<Lanes, Look::Judge> : sweep<Lanes, Look::JudgeAndMeasure>;
}

}  // namespace
}  // namespace kinemesh
