#pragma once

#include <array>
#include <vector>

#include "core/linalg/block_matrix.h"

namespace pleat {

/// A symmetric positive definite A seen through an incomplete factor.
///
/// A = N - E, where of the blocks below the diagonal of N = L + D + L' no symmetric part has an
/// eigenvalue above a hundredth of the smaller of both vertices' diagonal traces: larger positive
/// parts are moved to these diagonals, and E is the springs that they are. Vertices that hang leave
/// such between their parents.
///
/// M = (P + L) P^-1 (P + L') has N's diagonal blocks: P_i = D_i - sum_j L_ij P_j^-1 L_ij'. Of a
/// tree, in this order, M is N. W = (P + L)^-1 A (P + L')^-1 takes no more work than A: with t = (P
/// + L')^-1 p, W p = t + (P + L)^-1 (p + (D - 2 P) t - E t).
///
/// Vectors are in the order of the matrix's rows, three numbers each. Sources: Meijerink & van der
/// Vorst, An iterative solution method for linear systems of which the coefficient matrix is a
/// symmetric M-matrix, Mathematics of Computation 31, 1977; Eisenstat, Efficient implementation of
/// a class of preconditioned conjugate gradient methods, SIAM J. Sci. Stat. Comput. 2, 1981.
class IncompleteFactor {
 public:
  /// Takes the pattern of a lower triangle.
  void analyze(const SparseMatrix& lower);

  /// Takes the values; the pattern is the one last analysed. Returns the first row whose diagonal
  /// block is not positive definite, -1 if there is none. Where P_i is not, D_i takes its place.
  int compute(const SparseMatrix& lower);

  /// Order and size.
  const BlockMatrix& rows() const { return N_; }

  /// Gives A, which has the same pattern and order, its values.
  void copy_matrix(BlockMatrix& A) const;

  /// y = A x. x and y do not overlap.
  void multiply(const double* x, double* y) const;

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
  struct Lifted {
    int row, column, block;
    std::array<double, kPackedSize> positive;
  };

  void lift_positive_parts();
  void subtract_lifted(const double* x, double* y) const;
  const double* pivot(int row) const { return pivots_.data() + row * kPackedSize; }
  const double* inverse(int row) const { return inverses_.data() + row * kPackedSize; }

  BlockMatrix N_;
  std::vector<Lifted> lifted_;      // E
  std::vector<double> pivots_;      // P
  std::vector<double> inverses_;    // inverses of P's blocks
  std::vector<double> remainders_;  // D - 2 P
};

}  // namespace pleat
