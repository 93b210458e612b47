#include "motion/interior/conjugate_gradients.h"

#include <cmath>

#include "motion/interior/vertex_blocks.h"

namespace kinemesh {
namespace {

// Of 0, which is the diagonal where no face has an extent, it is 0: such a vertex stays at its start.
double inverse_of(double diagonal) {
  return diagonal > 0.0 ? 1.0 / diagonal : 0.0;
}

Block inverse_of(const Block& diagonal) {
  return diagonal[0][0] > 0.0 ? glm::inverse(diagonal) : Block(0.0);
}

double inverse_along(double diagonal, const Point&) {
  return inverse_of(diagonal);
}

Block inverse_along(const Block& diagonal, const Point& tangent) {
  return glm::outerProduct(tangent, tangent) * inverse_of(glm::dot(tangent, diagonal * tangent));
}

}  // namespace

template <class Weight>
ConjugateGradients<Weight>::ConjugateGradients(const Fans& fans, const SlidingVertices& sliding,
                                               CoarseLevel& coarse, GradientVectors<Weight>& vectors)
    : fans_(fans), sliding_(sliding), coarse_(coarse), vectors_(vectors) {
  vectors_.inverse.resize(fans.n_vertices());
  for (auto* vector : {&vectors_.residual, &vectors_.product, &vectors_.direction})
    vector->resize(fans.n_vertices());
  for (auto* vector : {&vectors_.sums, &vectors_.correction}) vector->resize(n_blocks(fans.n_vertices()));
}

template <class Weight>
Convergence ConjugateGradients<Weight>::solve(const Stiffness<Weight>& stiffness, double tolerance,
                                              int max_iterations, std::span<Point> x) {
  invert_diagonal(stiffness);
  const double norm = norm_of_right_hand_side(stiffness, x);
  if (norm == 0.0) return rest(x);
  Squares now = start(stiffness, x);
  Convergence result;
  const auto is_done = [&] {
    result.residual = std::sqrt(now.residual) / norm;
    return result.residual <= tolerance;
  };
  double last_energy = 0.0;
  while (!(result.reached = is_done()) && result.iterations < max_iterations) {
    turn(result.iterations == 0 ? 0.0 : now.energy / last_energy);
    const double curvature = multiply(stiffness);
    if (!(curvature > 0.0)) break;  // rounding has the last word
    last_energy = now.energy;
    now = descend(now.energy / curvature, x);
    ++result.iterations;
  }
  return result;
}

// Nothing pulls: the solution is 0.
template <class Weight>
Convergence ConjugateGradients<Weight>::rest(std::span<Point> x) const {
  for (const Vertex v : fans_.vertices())
    if (fans_.has_row(v)) x[v] = Point(0.0, 0.0);
  return {.reached = true};
}

template <class Weight>
void ConjugateGradients<Weight>::invert_diagonal(const Stiffness<Weight>& stiffness) {
  parallel_blocks(fans_.n_vertices(), [&](int, int begin, int end) {
    for (Vertex v(begin); v < end; ++v)
      vectors_.inverse[v] = fans_.has_row(v) ? inverse_of(stiffness.diagonal(fans_, v)) : Weight(0.0);
    for (const auto& [v, tangent] : sliding_.within(begin, end))
      if (fans_.has_row(v)) vectors_.inverse[v] = inverse_along(stiffness.diagonal(fans_, v), tangent);
  });
}

template <class Weight>
double ConjugateGradients<Weight>::norm_of_right_hand_side(const Stiffness<Weight>& stiffness,
                                                           std::span<const Point> x) {
  for (const Vertex v : fans_.vertices()) vectors_.direction[v] = fans_.has_row(v) ? Point(0.0, 0.0) : x[v];
  return std::sqrt(start(stiffness, vectors_.direction).residual);
}

// The residual of x.
template <class Weight>
auto ConjugateGradients<Weight>::start(const Stiffness<Weight>& stiffness, std::span<const Point> x)
    -> Squares {
  return precondition(sum_over_blocks(fans_.n_vertices(), [&](int begin, int end) {
    for (Vertex v(begin); v < end; ++v) vectors_.residual[v] = -stiffness.product(fans_, v, x.data());
    sliding_.project(begin, end, vectors_.residual);
    return sum_blocks(begin, end);
  }));
}

// Adds up the residuals by block; returns the square of their norm over the diagonal.
template <class Weight>
double ConjugateGradients<Weight>::sum_blocks(int begin, int end) {
  double square = 0.0;
  for (int first = begin; first < end; first += block_vertices) {
    Point sum(0.0, 0.0);
    for (Vertex v(first); v < std::min(first + block_vertices, end); ++v) {
      sum += vectors_.residual[v];
      square += glm::dot(vectors_.residual[v], vectors_.inverse[v] * vectors_.residual[v]);
    }
    vectors_.sums[block_of(Vertex(first))] = sum;
  }
  return square;
}

// The preconditioned residual is the residual over the diagonal plus the block's correction; it is not
// stored.
template <class Weight>
auto ConjugateGradients<Weight>::precondition(double residual) -> Squares {
  vectors_.correction = vectors_.sums;
  coarse_.solve(vectors_.correction);
  double energy = residual;
  for (std::size_t b = 0; b < vectors_.correction.size(); ++b)
    energy += glm::dot(vectors_.correction[b], vectors_.sums[b]);
  return {residual, energy};
}

template <class Weight>
void ConjugateGradients<Weight>::turn(double share) {
  parallel_blocks(fans_.n_vertices(), [&](int, int begin, int end) {
    for (Vertex v(begin); v < end; ++v)
      vectors_.direction[v] = fans_.has_row(v)
                                  ? vectors_.inverse[v] * vectors_.residual[v] +
                                        vectors_.correction[block_of(v)] + share * vectors_.direction[v]
                                  : Point(0.0, 0.0);
    sliding_.project(begin, end, vectors_.direction);
  });
}

template <class Weight>
double ConjugateGradients<Weight>::multiply(const Stiffness<Weight>& stiffness) {
  return sum_over_blocks(fans_.n_vertices(), [&](int begin, int end) {
    double curvature = 0.0;
    for (Vertex v(begin); v < end; ++v) {
      vectors_.product[v] = stiffness.product(fans_, v, vectors_.direction.data());
      curvature += glm::dot(vectors_.direction[v], vectors_.product[v]);
    }
    sliding_.project(begin, end, vectors_.product);
    return curvature;
  });
}

template <class Weight>
auto ConjugateGradients<Weight>::descend(double step, std::span<Point> x) -> Squares {
  return precondition(sum_over_blocks(fans_.n_vertices(), [&](int begin, int end) {
    for (Vertex v(begin); v < end; ++v) {
      if (fans_.has_row(v)) x[v] += step * vectors_.direction[v];
      vectors_.residual[v] -= step * vectors_.product[v];
    }
    return sum_blocks(begin, end);
  }));
}

template class ConjugateGradients<double>;
template class ConjugateGradients<Block>;

}  // namespace kinemesh
