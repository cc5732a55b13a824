#pragma once

#include <vector>

#include "core/linalg/block_matrix.h"

namespace pleat {

/// A symmetric positive definite A = L + D + L' seen through M = (P + L) P^-1 (P + L'), which has
/// the same diagonal blocks: of P, P_i = D_i - sum_j L_ij P_j^-1 L_ij'. Of a tree, M is A.
///
/// The preconditioned matrix W = (P + L)^-1 A (P + L')^-1 takes no more work than A: with
/// t = (P + L')^-1 p, W p = t + (P + L)^-1 (p + (D - 2 P) t). Vectors are in the order of the rows
/// of A, three numbers each. Sources: Meijerink & van der Vorst, An iterative solution method for
/// linear systems of which the coefficient matrix is a symmetric M-matrix, Mathematics of
/// Computation 31, 1977; Eisenstat, Efficient implementation of a class of preconditioned conjugate
/// gradient methods, SIAM J. Sci. Stat. Comput. 2, 1981.
class IncompleteFactor {
 public:
  /// A  outlives this.
  explicit IncompleteFactor(const BlockMatrix& A) : A_(A) {}

  /// For the present pattern of A.
  void analyze();

  /// For the present values of A. Returns the first row whose diagonal block is not positive
  /// definite, -1 if there is none. Where P_i is not, D_i takes its place.
  int compute();

  /// z = P r. Returns r'z.
  double multiply_pivots(const double* r, double* z) const;

  /// x = (P + L)^-1 b. x may be b.
  void solve_lower(const double* b, double* x) const;

  /// |(P + L) r|.
  double norm_of_lower_product(const double* r) const;

  /// t = (P + L')^-1 p and s with W p = t + s. Returns p'W p = t'A t.
  /// s  on entry zero
  double apply(const double* p, double* t, double* s) const;

 private:
  const double* pivot(int row) const { return pivots_.data() + row * kPackedSize; }
  const double* inverse(int row) const { return inverses_.data() + row * kPackedSize; }

  const BlockMatrix& A_;
  std::vector<double> pivots_;      // P
  std::vector<double> inverses_;    // of P
  std::vector<double> remainders_;  // D - 2 P
};

}  // namespace pleat
