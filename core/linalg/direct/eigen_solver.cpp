#include "core/linalg/direct/eigen_solver.h"

#include <Eigen/SparseCholesky>

namespace pleat {
namespace {

class EigenSolver final : public LinearSolver {
 public:
  void do_analyze(const SparseMatrix& lower) override { factor_.analyzePattern(lower); }

  SolveReport do_factorize(const SparseMatrix& lower) override {
    factor_.factorize(lower);
    if (factor_.info() == Eigen::Success) return {};
    return {SolveStatus::not_positive_definite, 0, 0, "a pivot is not positive"};
  }

  // Eigen's own solve() makes a temporary each time; the same steps on a kept array do not.
  SolveReport do_solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                       Eigen::Ref<Eigen::MatrixXd> solution) override {
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
  Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::AMDOrdering<int>> factor_;
  Eigen::MatrixXd permuted_;  // n x m, in the order of elimination
};

}  // namespace

std::unique_ptr<LinearSolver> make_eigen_solver() { return std::make_unique<EigenSolver>(); }

}  // namespace pleat
