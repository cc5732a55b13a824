#include "core/linalg/iterative/positive_part.h"

#include <Eigen/Eigenvalues>

#include "core/base/vec.h"

namespace pleat {

std::array<double, kPackedSize> positive_part(const double* block) {
  const Eigen::Map<const Mat3> B(block);  // transposed, which is as good
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen((B + B.transpose()) / 2);
  const Mat3 part = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
                    eigen.eigenvectors().transpose();
  return {part(0, 0), part(1, 0), part(1, 1), part(2, 0), part(2, 1), part(2, 2)};
}

}  // namespace pleat
