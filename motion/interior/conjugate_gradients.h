// Conjugate gradients for the stiffness matrix of a mesh, preconditioned by its diagonal and a coarse level.
#pragma once

#include <span>
#include <vector>

#include "motion/interior/fans.h"
#include "motion/interior/sliding.h"
#include "motion/interior/stiffness.h"
#include "motion/interior/two_level.h"

namespace kinemesh {

struct Convergence {
  bool reached = false;
  int iterations = 0;
  double residual = 0.0;  // its norm over the diagonal, relative to that of the right-hand side
};

// Memory, to be used again; nothing is kept in it.
template <class Weight>
struct GradientVectors {
  std::vector<Weight> inverse;           // of the diagonal, per vertex; along the tangent where it slides
  std::vector<Point> residual, product;  // per vertex
  std::vector<Point> direction;          // per vertex, 0 where there is no row
  std::vector<Point> sums, correction;   // per block: residuals, and what the coarse level says of them
};

// Finds x with (K x)_v = 0, along the tangent only where v slides, at all vertices v with a row, x being
// given at the others [Hestenes & Stiefel 1952]. Sums are formed in an order that depends on the number of
// vertices only.
template <class Weight>
class ConjugateGradients {
 public:
  // Keeps references.
  ConjugateGradients(const Fans& fans, const SlidingVertices& sliding, CoarseLevel& coarse,
                     GradientVectors<Weight>& vectors);

  // x: start vector before, last iterate after; vertices that slide have no part but the tangential one. Pre:
  // `coarse` is factorized for a matrix near this one.
  Convergence solve(const Stiffness<Weight>& stiffness, double tolerance, int max_iterations,
                    std::span<Point> x);

 private:
  struct Squares {
    double residual;  // over the diagonal
    double energy;    // residual times preconditioned residual
  };

  Convergence rest(std::span<Point> x) const;
  void invert_diagonal(const Stiffness<Weight>& stiffness);
  double norm_of_right_hand_side(const Stiffness<Weight>& stiffness, std::span<const Point> x);
  Squares start(const Stiffness<Weight>& stiffness, std::span<const Point> x);
  double multiply(const Stiffness<Weight>& stiffness);
  Squares descend(double step, std::span<Point> x);
  void turn(double share);
  double sum_blocks(int begin, int end);
  Squares precondition(double residual);

  const Fans& fans_;
  const SlidingVertices& sliding_;
  CoarseLevel& coarse_;
  GradientVectors<Weight>& vectors_;
};

extern template class ConjugateGradients<double>;
extern template class ConjugateGradients<Block>;

}  // namespace kinemesh
