#include "core/linalg/linear_solver.h"

#include "core/base/check.h"
#include "core/linalg/finite_check.h"

namespace pleat {

void LinearSolver::analyze(const SparseMatrix& lower) {
  PLEAT_CHECK(lower.rows() == lower.cols(), "the matrix must be square");
  PLEAT_CHECK(lower.isCompressed(), "the matrix must be compressed");
  for (Eigen::Index column = 0; column < lower.cols(); ++column) {
    SparseMatrix::InnerIterator entry(lower, column);
    PLEAT_CHECK(entry && entry.row() == column,
                "each column of the lower triangle must start with its diagonal entry");
  }
  n_ = -1;
  if (lower.rows() > 0) do_analyze(lower);
  n_ = lower.rows();
  n_entries_ = lower.nonZeros();
  factorized_ = false;
}

SolveReport LinearSolver::factorize(const SparseMatrix& lower) {
  PLEAT_CHECK(n_ >= 0, "analyze comes before factorize");
  PLEAT_CHECK(lower.isCompressed() && lower.rows() == n_ && lower.cols() == n_ &&
                  lower.nonZeros() == n_entries_,
              "factorize needs the pattern last analysed");
  factorized_ = false;
  if (auto report = report_not_finite(lower)) return *report;
  SolveReport report;
  if (n_ > 0) report = do_factorize(lower);
  factorized_ = report.ok();
  return report;
}

SolveReport LinearSolver::solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                                Eigen::Ref<Eigen::MatrixXd> solution) {
  PLEAT_CHECK(factorized_, "solve needs a factorisation that succeeded");
  PLEAT_CHECK(rhs.rows() == n_, "the right-hand sides must have as many rows as the matrix");
  PLEAT_CHECK(rhs.rows() == solution.rows() && rhs.cols() == solution.cols(),
              "right-hand sides and solution must have the same size");
  if (auto report = report_not_finite(rhs, "right-hand side")) return *report;
  if (rhs.size() == 0) return {};
  return do_solve(rhs, solution);
}

const char* name(SolverKind kind) { return kSolverNames[static_cast<std::size_t>(kind)]; }

const char* name(Preconditioner preconditioner) {
  return kPreconditionerNames[static_cast<std::size_t>(preconditioner)];
}

bool is_direct(SolverKind kind) { return kind != SolverKind::cg && kind != SolverKind::sor; }

void SolverOptions::validate() const {
  PLEAT_CHECK(tolerance > 0 && tolerance < 1, "the solver's tolerance must lie in (0, 1)");
  PLEAT_CHECK(max_iterations >= 1, "the solver's iteration cap must be at least 1");
  PLEAT_CHECK(omega >= 0 && omega < 2, "sor's omega must lie in (0, 2), or be 0 for an estimate");
}

}  // namespace pleat
