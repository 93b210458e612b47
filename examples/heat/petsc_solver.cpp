// Conjugate gradients with an incomplete Cholesky factorization by PETSc, on one process.
#include <petscksp.h>

#include <stdexcept>
#include <string>

#include "examples/heat/linear_solver.h"

namespace heat {
namespace {

void check(PetscErrorCode code) {
  if (code) throw std::runtime_error("PETSc fails with code " + std::to_string(code));
}

class PetscSolver : public LinearSolver {
 public:
  PetscSolver() {
    PetscBool is_running = PETSC_FALSE;
    check(PetscInitialized(&is_running));
    if (!is_running) check(PetscInitializeNoArguments());
  }
  ~PetscSolver() override { release(); }
  PetscSolver(const PetscSolver&) = delete;
  PetscSolver& operator=(const PetscSolver&) = delete;

  const char* name() const override { return "PETSc"; }

  // PETSc keeps to the arrays it is given.
  void factorize(const SparseMatrix& matrix) override {
    release();
    matrix_ = matrix;
    const PetscInt n = matrix_.size();
    check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, n, n, matrix_.start.data(), matrix_.column.data(),
                                    matrix_.value.data(), &a_));
    check(KSPCreate(PETSC_COMM_SELF, &solver_));
    check(KSPSetOperators(solver_, a_, a_));
    check(KSPSetType(solver_, KSPCG));
    PC preconditioner = nullptr;
    check(KSPGetPC(solver_, &preconditioner));
    check(PCSetType(preconditioner, PCICC));
    check(KSPSetTolerances(solver_, 1e-13, PETSC_DEFAULT, PETSC_DEFAULT, 10 * n));
    check(KSPSetUp(solver_));
  }

  std::vector<double> solve(std::span<const double> right_hand_side) override {
    const auto n = static_cast<PetscInt>(right_hand_side.size());
    std::vector<double> solution(right_hand_side.size());
    Vec b = nullptr, x = nullptr;
    check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, right_hand_side.data(), &b));
    check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, solution.data(), &x));
    check(KSPSolve(solver_, b, x));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check(KSPGetConvergedReason(solver_, &reason));
    check(VecDestroy(&b));
    check(VecDestroy(&x));
    if (reason <= 0) throw std::runtime_error("PETSc's conjugate gradients do not converge");
    return solution;
  }

 private:
  void release() {
    KSPDestroy(&solver_);
    MatDestroy(&a_);
  }

  SparseMatrix matrix_;
  Mat a_ = nullptr;
  KSP solver_ = nullptr;
};

}  // namespace

std::unique_ptr<LinearSolver> make_solver() {
  return std::make_unique<PetscSolver>();
}

}  // namespace heat
