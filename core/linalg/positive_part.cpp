#include "core/linalg/positive_part.h"

#include <Eigen/Eigenvalues>

#include "core/base/vec.h"

namespace pleat {

void positive_part(const double* block, double* positive) {
  const Eigen::Map<const Mat3> B(block);  // transposed, which is as good
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen((B + B.transpose()) / 2);
  const Mat3 part = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
                    eigen.eigenvectors().transpose();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c <= r; ++c) *positive++ = part(r, c);
}

}  // namespace pleat
