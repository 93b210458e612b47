#include "motion/interior/sparse_cholesky.h"

#include <cholmod.h>

#include <algorithm>
#include <new>

namespace kinemesh {

struct SparseCholesky::State {
  State() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SIMPLICIAL;
    common.final_ll = false;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
  }
  ~State() {
    cholmod_free_dense(&solution, &common);
    cholmod_free_dense(&scratch_y, &common);
    cholmod_free_dense(&scratch_e, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void require_memory(bool taken) const {
    if (!taken || common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  }

  cholmod_common common;
  cholmod_factor* factor = nullptr;
  cholmod_dense *solution = nullptr, *scratch_y = nullptr, *scratch_e = nullptr;
};

namespace {

// Rows of the lower half are columns of the upper one. CHOLMOD only reads what it is lent here.
cholmod_sparse view(const LowerMatrix& matrix) {
  const auto size = static_cast<std::size_t>(matrix.size());
  cholmod_sparse a{};
  a.nrow = a.ncol = size;
  a.nzmax = matrix.column.size();
  a.p = const_cast<int*>(matrix.start.data());
  a.i = const_cast<int*>(matrix.column.data());
  a.x = const_cast<double*>(matrix.value.data());
  a.stype = 1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  return a;
}

}  // namespace

SparseCholesky::SparseCholesky() : state_(std::make_unique<State>()) {}
SparseCholesky::~SparseCholesky() = default;

void SparseCholesky::analyze(const LowerMatrix& matrix) {
  cholmod_free_factor(&state_->factor, &state_->common);
  auto a = view(matrix);
  state_->factor = cholmod_analyze(&a, &state_->common);
  state_->require_memory(state_->factor != nullptr);
}

bool SparseCholesky::factorize(const LowerMatrix& matrix) {
  auto a = view(matrix);
  state_->require_memory(cholmod_factorize(&a, state_->factor, &state_->common) != 0);
  return state_->factor->minor == state_->factor->n;
}

void SparseCholesky::solve(std::span<double> columns) {
  const auto n = state_->factor->n;
  cholmod_dense right{};
  right.nrow = right.d = n;
  right.ncol = columns.size() / n;
  right.nzmax = columns.size();
  right.x = columns.data();
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  state_->require_memory(cholmod_solve2(CHOLMOD_A, state_->factor, &right, nullptr, &state_->solution,
                                        nullptr, &state_->scratch_y, &state_->scratch_e,
                                        &state_->common) != 0);
  std::copy_n(static_cast<const double*>(state_->solution->x), columns.size(), columns.begin());
}

}  // namespace kinemesh
