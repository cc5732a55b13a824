#include "core/linalg/direct/cholmod_solver.h"

#include <cholmod.h>

#include <algorithm>
#include <new>
#include <string>

#include "core/base/check.h"

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

cholmod_dense view(const Eigen::Ref<const Eigen::MatrixXd>& columns) {
  cholmod_dense B{};
  B.nrow = static_cast<std::size_t>(columns.rows());
  B.ncol = static_cast<std::size_t>(columns.cols());
  B.d = static_cast<std::size_t>(std::max(columns.outerStride(), columns.rows()));
  B.nzmax = B.d * B.ncol;
  B.x = const_cast<double*>(columns.data());
  B.xtype = CHOLMOD_REAL;
  B.dtype = CHOLMOD_DOUBLE;
  return B;
}

/// cholmod_solve2 leaves its work array described as narrower than its memory is, and would
/// allocate it again.
void restore_width(cholmod_dense* work) {
  if (work == nullptr) return;
  work->nrow = work->nzmax / work->ncol;
  work->d = work->nrow;
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
    cholmod_free_dense(&X_, &common_);
    cholmod_free_dense(&Y_, &common_);
    cholmod_free_dense(&E_, &common_);
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
    return {};
  }

  SolveReport do_solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                       Eigen::Ref<Eigen::MatrixXd> solution) override {
    cholmod_dense B = view(rhs);
    restore_width(Y_);
    const int solved =
        cholmod_solve2(CHOLMOD_A, factor_, &B, nullptr, &X_, nullptr, &Y_, &E_, &common_);
    check_memory();
    PLEAT_CHECK(solved, "CHOLMOD refused to solve");
    solution = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(X_->x), rhs.rows(),
                                                 rhs.cols());
    return {};
  }

 private:
  void check_memory() const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    PLEAT_CHECK(common_.status >= 0, "CHOLMOD reports a wrong call");
  }

  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* X_ = nullptr;  // the solution and two work arrays, kept from solve to solve
  cholmod_dense* Y_ = nullptr;
  cholmod_dense* E_ = nullptr;
};

}  // namespace

std::unique_ptr<LinearSolver> make_cholmod_solver() { return std::make_unique<CholmodSolver>(); }

}  // namespace pleat
