#include "core/linalg/direct/cholmod_solver.h"

#include <cholmod.h>

#include <new>
#include <string>

#include "core/base/check.h"
#include "core/linalg/direct/column_solve.h"

namespace pleat {
namespace {

/// Views the matrix as CHOLMOD's, without a copy. CHOLMOD takes no const, but only reads it.
cholmod_sparse view(const SparseMatrix& lower) {
  cholmod_sparse A{};
  A.nrow = static_cast<std::size_t>(lower.rows());
  A.ncol = static_cast<std::size_t>(lower.cols());
  A.nzmax = static_cast<std::size_t>(lower.nonZeros());
  A.p = const_cast<int*>(lower.outerIndexPtr());
  A.i = const_cast<int*>(lower.innerIndexPtr());
  A.x = const_cast<double*>(lower.valuePtr());
  A.stype = -1;  // lower triangle of a symmetric matrix
  A.itype = CHOLMOD_INT;
  A.xtype = CHOLMOD_REAL;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = 1;
  A.packed = 1;
  return A;
}

LowerColumns columns_of(const cholmod_factor& L) {
  return {static_cast<int>(L.n), static_cast<const int*>(L.p), static_cast<const int*>(L.nz),
          static_cast<const int*>(L.i), static_cast<const double*>(L.x)};
}

class CholmodSolver final : public LinearSolver {
 public:
  CholmodSolver() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SIMPLICIAL;
    common_.final_asis = 0;
    common_.final_ll = 1;
    // One ordering only: by default the native library would also try METIS, which the other build
    // does not have.
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_AMD;
    common_.postorder = 1;
    common_.quick_return_if_not_posdef = 1;
  }

  ~CholmodSolver() override {
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }

  CholmodSolver(const CholmodSolver&) = delete;
  CholmodSolver& operator=(const CholmodSolver&) = delete;

  void do_analyze(const SparseMatrix& lower) override {
    cholmod_free_factor(&factor_, &common_);
    cholmod_sparse A = view(lower);
    factor_ = cholmod_analyze(&A, &common_);
    check_memory();
  }

  SolveReport do_factorize(const SparseMatrix& lower) override {
    cholmod_sparse A = view(lower);
    cholmod_factorize(&A, factor_, &common_);
    check_memory();
    if (common_.status == CHOLMOD_NOT_POSDEF) {
      // `minor` counts in the order of elimination; Perm leads back to the caller's.
      const int* permutation = static_cast<const int*>(factor_->Perm);
      return {SolveStatus::not_positive_definite, 0, 0,
              "pivot of row " + std::to_string(permutation[factor_->minor]) + " is not positive"};
    }
    columns_.prepare(columns_of(*factor_));
    return {};
  }

  SolveReport do_solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                       Eigen::Ref<Eigen::MatrixXd> solution) override {
    columns_.solve(columns_of(*factor_), static_cast<const int*>(factor_->Perm), rhs, solution);
    return {};
  }

 private:
  void check_memory() const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    PLEAT_CHECK(common_.status >= 0, "CHOLMOD reports a wrong call");
  }

  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  ColumnSolve columns_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_cholmod_solver() { return std::make_unique<CholmodSolver>(); }

}  // namespace pleat
