#include "core/linalg/eigen_solver.h"

#include <Eigen/SparseCholesky>

#include "core/linalg/call_order.h"

namespace pleat {
namespace {

class EigenSolver final : public LinearSolver {
 public:
  void analyze(const SparseMatrix& lower) override {
    order_.analyzed(lower);
    if (lower.rows() > 0) factor_.analyzePattern(lower);
  }

  SolveReport factorize(const SparseMatrix& lower) override {
    order_.begin_factorize(lower);
    if (auto report = report_not_finite(lower)) return *report;
    if (lower.rows() > 0) {
      factor_.factorize(lower);
      if (factor_.info() != Eigen::Success) {
        return {SolveStatus::not_positive_definite, 0, 0, "a pivot is not positive"};
      }
    }
    order_.factorized();
    return {};
  }

  // Eigen's own solve() makes a temporary each time; the same steps on a kept array do not.
  SolveReport solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                    Eigen::Ref<Eigen::MatrixXd> solution) override {
    order_.check_solve(rhs, solution);
    if (auto report = report_not_finite(rhs, "right-hand side")) return *report;
    if (rhs.size() == 0) return {};
    permuted_.resize(rhs.rows(), rhs.cols());
    const bool reordered = factor_.permutationP().size() > 0;
    if (reordered) {
      permuted_.noalias() = factor_.permutationP() * rhs;
    } else {
      permuted_ = rhs;
    }
    factor_.matrixL().solveInPlace(permuted_);
    factor_.matrixU().solveInPlace(permuted_);
    if (reordered) {
      solution.noalias() = factor_.permutationPinv() * permuted_;
    } else {
      solution = permuted_;
    }
    return {};
  }

 private:
  CallOrder order_;
  Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::AMDOrdering<int>> factor_;
  Eigen::MatrixXd permuted_;  // n x m, in the order of elimination
};

}  // namespace

std::unique_ptr<LinearSolver> make_eigen_solver() { return std::make_unique<EigenSolver>(); }

}  // namespace pleat
