// The coarse level of a preconditioner: displacements that are constant on blocks of vertices.
//
// Additive Schwarz of two levels with a coarse space of piecewise constants [Nicolaides 1987; Smith 1996, ch.
// 2]: the diagonal takes care of what varies from vertex to vertex, and of the rest, a matrix of one row or
// two for 32 vertices, CHOLMOD does the whole. Iterations hardly depend on the size of the mesh.
#pragma once

#include <span>
#include <vector>

#include "motion/interior/fans.h"
#include "motion/interior/sliding.h"
#include "motion/interior/sparse_cholesky.h"
#include "motion/interior/stiffness.h"

namespace kinemesh {

// Coarse unknowns are the blocks of motion/interior/vertex_blocks.h, once for both coordinates where the
// matrix is the same for both and does not mix them, and else twice.
class CoarseLevel {
 public:
  // Finds which blocks are neighbours. In all threads, but for the ordering of the matrix: O(n / 32) times a
  // logarithm.
  void analyze(const Fans& fans, bool is_coupled);

  // Pre: analyzed with the same fans, and is_coupled for Block and wherever vertices slide.
  template <class Weight>
  void factorize(const Fans& fans, const Stiffness<Weight>& stiffness, const SlidingVertices& sliding);

  // Sums of residuals per block become corrections, the same for all its vertices; 0 if the matrix is
  // singular.
  void solve(std::span<Point> blocks);

 private:
  void find_neighbours(const Fans& fans);
  void lay_out();
  void write_row(int block, std::span<const double> entries);
  void write_row(int block, std::span<const Block> entries);

  bool is_coupled_ = false;
  bool is_usable_ = false;
  std::vector<int> start_, neighbour_;  // per block, the blocks up to itself it has edges to, ascending
  LowerMatrix matrix_;
  SparseCholesky cholesky_;
  std::vector<double> columns_;
};

}  // namespace kinemesh
