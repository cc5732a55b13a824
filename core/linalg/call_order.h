#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "core/linalg/solve_report.h"
#include "core/linalg/sparse.h"

namespace pleat {

/// Holds the callers of a LinearSolver to analyze, factorize, solve, with sizes that agree.
class CallOrder {
 public:
  /// Throws ContractError unless `lower` is square, compressed, without entries above the diagonal
  /// and with every diagonal entry.
  void analyzed(const SparseMatrix& lower);

  /// Throws ContractError before `analyzed`, or when the size or the number of entries has changed.
  void begin_factorize(const SparseMatrix& lower);
  void factorized() { factorized_ = true; }

  /// Throws ContractError unless the last factorisation succeeded and the sizes agree with it.
  void check_solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                   const Eigen::Ref<const Eigen::MatrixXd>& solution) const;

 private:
  Eigen::Index n_ = -1;  // -1 before the first analyze
  Eigen::Index n_entries_ = 0;
  bool factorized_ = false;
};

/// Report of status not_finite naming the first entry of the matrix that is NaN or infinite, if
/// there is one.
std::optional<SolveReport> report_not_finite(const SparseMatrix& lower);

/// The same for right-hand sides (`what` names them in the message).
std::optional<SolveReport> report_not_finite(const Eigen::Ref<const Eigen::MatrixXd>& columns,
                                             const char* what);

}  // namespace pleat
