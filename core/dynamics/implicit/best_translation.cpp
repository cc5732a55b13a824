#include "core/dynamics/implicit/best_translation.h"

#include <Eigen/Dense>

namespace pleat {

// With Z the translations of the free vertices, t = (Z'A Z)^-1 Z'(b - A x). Both sums are found in
// one pass over the lower triangle: in each column the rest of the block on the diagonal comes
// first, the blocks below follow.
Vec3 best_translation(const SparseMatrix& lower, const PositionsView& rhs,
                      const PositionsView& solution, std::span<const char> is_free) {
  Mat3 coarse = Mat3::Zero();
  Vec3 left = Vec3::Zero();
  for (int vertex = 0; vertex < solution.cols(); ++vertex) {
    if (is_free[static_cast<std::size_t>(vertex)] == 0) continue;
    const Vec3 x = solution.col(vertex);
    left += rhs.col(vertex);
    for (int k = 0; k < 3; ++k) {
      const int column = 3 * vertex + k;
      const double* value = lower.valuePtr() + lower.outerIndexPtr()[column];
      const int* row = lower.innerIndexPtr() + lower.outerIndexPtr()[column];
      const int* end = lower.innerIndexPtr() + lower.outerIndexPtr()[column + 1];
      coarse(k, k) += *value;
      left[k] -= *value * x[k];
      for (int i = k + 1; i < 3; ++i) {
        const double entry = value[i - k];
        coarse(i, k) += entry;
        coarse(k, i) += entry;
        left[i] -= entry * x[k];
        left[k] -= entry * x[i];
      }
      Vec3 sum = Vec3::Zero();
      double along = 0;
      for (value += 3 - k, row += 3 - k; row != end; value += 3, row += 3) {
        const Eigen::Map<const Vec3> entries(value);
        sum += entries;
        along += entries.dot(solution.col(*row / 3));
      }
      coarse.col(k) += sum;
      coarse.row(k) += sum.transpose();
      left -= x[k] * sum;
      left[k] -= along;
    }
  }
  if (coarse.isZero(0)) return Vec3::Zero();
  return coarse.llt().solve(left);
}

}  // namespace pleat
