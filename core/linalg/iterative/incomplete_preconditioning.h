#pragma once

#include "core/linalg/iterative/incomplete_factor.h"
#include "core/linalg/iterative/preconditioning.h"

namespace pleat {

/// An incomplete factor at no cost beside A's: it iterates on W = (P + L)^-1 A (P + L')^-1 in the
/// metric of P. x moves along t = (P + L')^-1 p, and the residual of A x = b is (P + L) r.
class IncompletePreconditioning final : public Preconditioning {
 public:
  void analyze(const SparseMatrix& lower);
  /// See IncompleteFactor::compute.
  int compute(const SparseMatrix& lower) { return factor_.compute(lower); }
  const IncompleteFactor& factor() const { return factor_; }

  double start(const std::vector<double>& b, const std::vector<double>& x) override;
  double next_direction() override;
  void advance(double curvature, std::vector<double>& x) override;
  double residual(double goal, Look look) override;

 private:
  IncompleteFactor factor_;
  std::vector<double> r_;
  std::vector<double> z_;  // P r
  std::vector<double> p_;
  std::vector<double> t_;
  std::vector<double> s_;  // W p - t
  double residual_ = 0;    // |b - A x|, as far as it is known
  double r_z_ = 0;         // r'z
  double ratio_ = 0;       // ratio of the residual to the root of r'z, when both were last known
  double beta_ = 0;
};

}  // namespace pleat
