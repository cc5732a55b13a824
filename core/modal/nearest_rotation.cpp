#include "core/modal/nearest_rotation.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

namespace pleat {

RotationSvd rotation_svd(const Mat3& F) {
  const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  RotationSvd result{svd.matrixU(), svd.matrixV(), svd.singularValues()};
  if (result.U.determinant() < 0) {
    result.U.col(2) *= -1;
    result.s[2] *= -1;
  }
  if (result.V.determinant() < 0) {
    result.V.col(2) *= -1;
    result.s[2] *= -1;
  }
  return result;
}

// Newton's iteration for X' X = I converges to the orthogonal factor of F, which is a rotation
// where F keeps its orientation. It doubles its digits each time: a move of 1e-8 is the last.
Mat3 nearest_rotation(const Mat3& F) {
  constexpr double kLeastVolume = 1e-3;  // relative to |F|^3
  constexpr double kLastMove = 1e-8;
  constexpr int kMostMoves = 20;
  const double size = F.norm();
  if (F.determinant() > kLeastVolume * size * size * size) {
    Mat3 X = F;
    for (int move = 0; move < kMostMoves; ++move) {
      const Mat3 inverse = X.inverse().transpose();
      const double scale = std::sqrt(inverse.norm() / X.norm());
      const Mat3 next = 0.5 * (scale * X + inverse / scale);
      const bool is_last = (next - X).squaredNorm() < kLastMove * kLastMove;
      X = next;
      if (is_last) return X;
    }
  }
  const RotationSvd svd = rotation_svd(F);
  return svd.U * svd.V.transpose();
}

}  // namespace pleat
