// Sparse Cholesky factorization by CHOLMOD, of SuiteSparse.
#include <cholmod.h>

#include <algorithm>
#include <stdexcept>

#include "examples/heat/linear_solver.h"

namespace heat {
namespace {

class CholmodSolver : public LinearSolver {
 public:
  CholmodSolver() { cholmod_start(&common_); }
  ~CholmodSolver() override {
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }
  CholmodSolver(const CholmodSolver&) = delete;
  CholmodSolver& operator=(const CholmodSolver&) = delete;

  const char* name() const override { return "CHOLMOD"; }

  // Rows of a symmetric matrix are columns, and CHOLMOD reads the upper half of them.
  void factorize(const SparseMatrix& matrix) override {
    cholmod_free_factor(&factor_, &common_);
    const auto n = static_cast<std::size_t>(matrix.size());
    cholmod_sparse* a =
        cholmod_allocate_sparse(n, n, matrix.value.size(), true, true, 1, CHOLMOD_REAL, &common_);
    if (!a) throw std::runtime_error("CHOLMOD has no memory");
    std::ranges::copy(matrix.start, static_cast<int*>(a->p));
    std::ranges::copy(matrix.column, static_cast<int*>(a->i));
    std::ranges::copy(matrix.value, static_cast<double*>(a->x));
    factor_ = cholmod_analyze(a, &common_);
    cholmod_factorize(a, factor_, &common_);
    cholmod_free_sparse(&a, &common_);
    if (common_.status != CHOLMOD_OK) throw std::runtime_error("CHOLMOD cannot factorize the matrix");
  }

  std::vector<double> solve(std::span<const double> right_hand_side) override {
    const auto n = right_hand_side.size();
    cholmod_dense* b = cholmod_allocate_dense(n, 1, n, CHOLMOD_REAL, &common_);
    if (!b) throw std::runtime_error("CHOLMOD has no memory");
    std::ranges::copy(right_hand_side, static_cast<double*>(b->x));
    cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor_, b, &common_);
    cholmod_free_dense(&b, &common_);
    if (!x) throw std::runtime_error("CHOLMOD cannot solve");
    const auto* values = static_cast<const double*>(x->x);
    std::vector<double> solution(values, values + n);
    cholmod_free_dense(&x, &common_);
    return solution;
  }

 private:
  cholmod_common common_;
  cholmod_factor* factor_ = nullptr;
};

}  // namespace

std::unique_ptr<LinearSolver> make_solver() {
  return std::make_unique<CholmodSolver>();
}

}  // namespace heat
