#pragma once

#include <vector>

#include "core/linalg/aggregation/lower_pattern.h"

namespace pleat {

/// Numbers of a row of a vector in single precision: B of them, then zeros up to a multiple of 4.
template <int B>
inline constexpr int kLanes = (B + 3) / 4 * 4;

/// Numbers that arrays of blocks hold beyond their end, where four are loaded across it.
constexpr int kLoadRoom = 4;

/// A symmetric positive definite matrix in B x B blocks as a level of a multigrid cycle sees it:
/// its values in double precision, and in single precision what smooths.
///
/// The level works on scaled unknowns, C'x where C C' = D is the diagonal: there the matrix is
/// I + L + L', and rounding is judged by what is stiff about a row, not by the stiffest of all. The
/// smoother is a Gauss-Seidel sweep forward and one backward. Vectors have kLanes<B> floats a row.
/// Each use passes L, held once.
template <int B>
class BlockLevel {
 public:
  static constexpr int kSize = B * B;

  /// Its values are zero then.
  void set_pattern(LowerPattern pattern);
  const LowerPattern& pattern() const { return pattern_; }
  int n_rows() const { return pattern_.n_rows(); }

  /// Blocks row by row: those of the diagonal, then those below it. To be filled before `scale`.
  double* diagonal(int row) { return values_.data() + row * kSize; }
  const double* diagonal(int row) const { return values_.data() + row * kSize; }
  double* lower(int block) { return values_.data() + (n_rows() + block) * kSize; }
  const double* lower(int block) const { return values_.data() + (n_rows() + block) * kSize; }
  std::vector<double>& values() { return values_; }

  /// Scales the values and makes what smooths of them. A diagonal block that has no inverse counts
  /// as its trace.
  void scale();
  /// C and its inverse, lower triangles by rows.
  const double* root(int row) const { return roots_.data() + row * kSize; }
  const double* inverse_root(int row) const { return inverse_roots_.data() + row * kSize; }

  /// Right-hand side, and solution, of scaled unknowns.
  float* rhs() { return b_.data(); }
  float* solution() { return x_.data(); }

  /// Both sweeps from x = 0, or from the x that is there.
  void smooth_from_zero();
  void smooth();
  /// Computes the residual after the last sweep.
  void find_residual();
  const float* residual() const { return r_.data(); }

 private:
  const float* low(int block) const { return low_.data() + block * kSize; }
  void sweep_forward();
  void sweep_backward();

  LowerPattern pattern_;
  std::vector<double> values_;
  std::vector<double> roots_, inverse_roots_;
  std::vector<float> low_;  // L, and room to load beyond its end
  std::vector<float> b_, x_, r_;
  std::vector<float> g_;  // b - L x of a forward sweep
  std::vector<float> u_;  // L'x of a backward sweep
};

extern template class BlockLevel<3>;
extern template class BlockLevel<6>;

}  // namespace pleat
