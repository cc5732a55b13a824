#pragma once

#include "core/linalg/aggregation/multigrid.h"
#include "core/linalg/iterative/incomplete_factor.h"
#include "core/linalg/iterative/preconditioning.h"

namespace pleat {

/// A multigrid cycle for each step. All is virtual: a program that makes none does not contain it.
///
/// As the cycle is symmetric to single precision alone, a direction is kept apart from the one
/// before by what the residual has changed. Source: Golub & Ye, Inexact preconditioned conjugate
/// gradient method with inner-outer iteration, SIAM J. Sci. Comput. 21, 1999.
class MultigridPreconditioning : public Preconditioning {
 public:
  /// Takes the pattern of a matrix and the order of its rows.
  virtual void analyze(const BlockMatrix& rows);

  /// Takes the values of a matrix with an incomplete factor, whose diagonal blocks are positive
  /// definite; the pattern is the one last analysed.
  /// places  of the vertices, three each [m]; empty: not known
  virtual void compute(const IncompleteFactor& factor, const std::vector<double>& places);

  double start(const std::vector<double>& b, const std::vector<double>& x) override;
  double next_direction() override;
  void advance(double curvature, std::vector<double>& x) override;
  double residual(double goal, Look look) override;

 private:
  BlockMatrix A_;
  Multigrid multigrid_;
  std::vector<double> r_;
  std::vector<double> z_;  // M^-1 r
  std::vector<double> p_;
  std::vector<double> image_;  // A p
  double residual_ = 0;
  double r_z_ = 0;    // product of r and z; 0 before the first
  double alpha_ = 0;  // length of the last step
};

}  // namespace pleat
