#pragma once

#include <vector>

#include "core/linalg/block_matrix.h"
#include "core/linalg/linear_solver.h"

namespace pleat {

/// A solver that comes nearer to the solution step by step, one right-hand side after the other, on
/// the 3 x 3 blocks of a matrix.
class BlockIteration : public LinearSolver {
 public:
  void set_tolerance(double tolerance) final { options_.tolerance = tolerance; }

 protected:
  explicit BlockIteration(const SolverOptions& options) : options_(options) {}

  SolveReport do_solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                       Eigen::Ref<Eigen::MatrixXd> solution) final;

  /// The matrix whose order of rows b_ and x_ have, or null where it is that of the unknowns.
  virtual const BlockMatrix* ordered() const { return nullptr; }
  /// Goes from x_, or from zero when that is nearer, to |b - A x| <= tolerance |b|, positive |b|.
  virtual SolveReport solve_column(double b_norm) = 0;

  static double norm(const std::vector<double>& values);

  SolverOptions options_;
  std::vector<double> b_;
  std::vector<double> x_;

 private:
  void gather(const double* from, std::vector<double>& to) const;
};

}  // namespace pleat
