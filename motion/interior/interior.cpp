#include "motion/interior/interior.h"

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "kinemesh/error.h"
#include "motion/interior/conjugate_gradients.h"
#include "motion/interior/moving_parts.h"
#include "motion/interior/stiffness.h"
#include "motion/interior/vertex_blocks.h"

namespace kinemesh {
namespace {

void check(const InteriorOptions& options) {
  for (const auto& [label, stiffness] : options.stiffness)
    if (!(stiffness >= least_stiffness && stiffness <= most_stiffness))
      throw InputError("interior: the stiffness of label " + std::to_string(label) +
                       " is to be a number from 1e-6 to 1e6");
  if (!(options.tolerance > 0.0)) throw InputError("interior: a tolerance above 0 expected");
  if (options.max_iterations < 1) throw InputError("interior: max_iterations: a number above 0 expected");
}

SlidingVertices sliding_vertices(const InteriorProblem& problem) {
  SlidingVertices sliding(static_cast<int>(problem.roles.size()));
  for (const Vertex v : Numbers<Vertex>(static_cast<int>(problem.roles.size())))
    if (problem.roles[v] == Role::Slide) sliding.add(v, problem.tangents.at(v));
  return sliding;
}

// Where nothing pulls, nothing moves; and vertices that slide start along their tangent.
void clear_start(const InteriorProblem& problem, const std::vector<char>& is_unknown,
                 const SlidingVertices& sliding, std::span<Point> increments) {
  for (std::size_t v = 0; v < increments.size(); ++v)
    if (!is_unknown[v] && problem.roles[v] != Role::Known) increments[v] = Point(0.0, 0.0);
  sliding.project(0, static_cast<int>(increments.size()), increments);
}

void go_halfway(const Mesh& mesh, std::span<const Point> others, std::span<const Point> increments,
                std::vector<Point>& halfway) {
  halfway.resize(mesh.n_vertices());
  parallel_blocks(mesh.n_vertices(), [&](int, int begin, int end) {
    for (Vertex v(begin); v < end; ++v) {
      const Point increment = others.empty() ? increments[v] : increments[v] + others[v];
      halfway[v] = mesh.position(v) + 0.5 * increment;
    }
  });
}

}  // namespace

class Interior::Solver {
 public:
  virtual ~Solver() = default;
  virtual InteriorSolution solve(const Mesh& mesh, const InteriorProblem& problem,
                                 std::span<Point> increments) = 0;
};

// Keeps its memory from one step to the next, and nothing else.
template <class Weight>
class Interior::WeightedSolver : public Interior::Solver {
 public:
  WeightedSolver(const Mesh& mesh, const InteriorOptions& options) : options_(options) {
    fans_.reserve(mesh);
    stiffness_.reserve(2 * mesh.n_edges());
    scales_.reserve(mesh.n_faces());
    halfway_.reserve(mesh.n_vertices());
  }

  InteriorSolution solve(const Mesh& mesh, const InteriorProblem& problem,
                         std::span<Point> increments) override {
    parts_.find(mesh, problem.roles, increments);
    const SlidingVertices sliding = sliding_vertices(problem);
    clear_start(problem, parts_.moves(), sliding, increments);
    if (!parts_.any_moves()) return {};

    fans_.build(mesh, parts_.moves());
    coarse_.analyze(fans_, std::is_same_v<Weight, Block> || !sliding.empty());
    ConjugateGradients<Weight> gradients(fans_, sliding, coarse_, vectors_);
    const Convergence first = solve_on(mesh, mesh.positions(), sliding, gradients, increments);
    if (!first.reached) return {false, first.iterations, first.residual};
    go_halfway(mesh, problem.others, increments, halfway_);
    const Convergence second = solve_on(mesh, halfway_, sliding, gradients, increments);
    return {second.reached, first.iterations + second.iterations, second.residual};
  }

 private:
  Convergence solve_on(const Mesh& mesh, std::span<const Point> positions, const SlidingVertices& sliding,
                       ConjugateGradients<Weight>& gradients, std::span<Point> increments) {
    scale_faces(mesh, positions, options_.stiffness, scales_);
    stiffness_.fill(fans_, positions, scales_);
    coarse_.factorize(fans_, stiffness_, sliding);
    return gradients.solve(stiffness_, options_.tolerance, options_.max_iterations, increments);
  }

  InteriorOptions options_;
  MovingParts parts_;
  Fans fans_;
  CoarseLevel coarse_;
  Stiffness<Weight> stiffness_;
  GradientVectors<Weight> vectors_;
  std::vector<double> scales_;  // per face
  std::vector<Point> halfway_;  // positions
};

Interior::Interior(const Mesh& mesh, const InteriorOptions& options) {
  check(options);
  if (options.follow == Follow::Harmonic) solver_ = std::make_unique<WeightedSolver<double>>(mesh, options);
  if (options.follow == Follow::Elastic) solver_ = std::make_unique<WeightedSolver<Block>>(mesh, options);
}

Interior::~Interior() = default;
Interior::Interior(Interior&&) noexcept = default;
Interior& Interior::operator=(Interior&&) noexcept = default;

InteriorSolution Interior::solve(const Mesh& mesh, const InteriorProblem& problem,
                                 std::span<Point> increments) {
  if (solver_) return solver_->solve(mesh, problem, increments);
  for (std::size_t v = 0; v < increments.size(); ++v)
    if (problem.roles[v] != Role::Known) increments[v] = Point(0.0, 0.0);
  return {};
}

}  // namespace kinemesh
