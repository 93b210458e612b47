// What the heat example asks of a solver library; cholmod_solver.cpp and petsc_solver.cpp answer.
#pragma once

#include <memory>
#include <span>
#include <vector>

namespace heat {

// Symmetric and positive definite; all entries, row by row, columns ascending.
struct SparseMatrix {
  std::vector<int> start{0};  // of each row, and the end
  std::vector<int> column;
  std::vector<double> value;

  int size() const { return static_cast<int>(start.size()) - 1; }
};

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  virtual const char* name() const = 0;
  virtual void factorize(const SparseMatrix& matrix) = 0;                          // std::runtime_error
  virtual std::vector<double> solve(std::span<const double> right_hand_side) = 0;  // with the last matrix
};

std::unique_ptr<LinearSolver> make_solver();

}  // namespace heat
