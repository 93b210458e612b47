// Sparse Cholesky factorization by CHOLMOD, of SuiteSparse [Chen 2008].
#pragma once

#include <memory>
#include <span>
#include <vector>

namespace kinemesh {

// A symmetric matrix by the rows of its lower half, columns ascending and the diagonal last: what is above
// need not be there.
struct LowerMatrix {
  std::vector<int> start;   // per row, and one more
  std::vector<int> column;  // per entry
  std::vector<double> value;

  int size() const { return static_cast<int>(start.size()) - 1; }
};

// L D L^T, column by column: without BLAS, so that its bits do not depend on threads.
class SparseCholesky {
 public:
  SparseCholesky();
  ~SparseCholesky();
  SparseCholesky(const SparseCholesky&) = delete;
  SparseCholesky& operator=(const SparseCholesky&) = delete;

  // Orders rows so that few entries are filled in; reads no values. Throws std::bad_alloc, as all do.
  void analyze(const LowerMatrix& matrix);

  // False if a pivot is 0. Pre: analyzed with the same places of entries.
  [[nodiscard]] bool factorize(const LowerMatrix& matrix);

  // Columns of right-hand sides, one after the other, become solutions. Pre: factorized.
  void solve(std::span<double> columns);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kinemesh
