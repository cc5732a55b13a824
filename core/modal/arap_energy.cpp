#include "core/modal/arap_energy.h"

#include <Eigen/SVD>
#include <cmath>

#include "core/base/check.h"

namespace pleat {
namespace {

/// F = U diag(s) V' with rotations U and V; the last of s is negative where F turns inside out.
struct RotationSvd {
  Mat3 U, V;
  Vec3 s;
};

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

using Mat9 = Eigen::Matrix<double, 9, 9>;
using Vec9 = Eigen::Matrix<double, 9, 1>;

/// d2/dF2 of min_R |F - R|^2, of the columns of F one below the other: 2 I less 4/(s_i + s_j) in
/// the directions in which R turns,
///
///     t_k = U (e_i e_j' - e_j e_i') V' / sqrt 2.
Mat9 distance_hessian(const Mat3& F) {
  constexpr double kLeastSum = 1e-8;  // where no rotation is the nearest, the Hessian has a pole
  const RotationSvd svd = rotation_svd(F);
  Mat9 hessian = 2 * Mat9::Identity();
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    const Mat3 turn =
        (svd.U.col(i) * svd.V.col(j).transpose() - svd.U.col(j) * svd.V.col(i).transpose()) /
        std::sqrt(2.0);
    const Eigen::Map<const Vec9> t(turn.data());
    const double sum = svd.s[i] + svd.s[j];
    hessian -= 4 / (std::abs(sum) > kLeastSum ? sum : kLeastSum) * t * t.transpose();
  }
  return hessian;
}

}  // namespace

Mat3 nearest_rotation(const Mat3& F) {
  const RotationSvd svd = rotation_svd(F);
  return svd.U * svd.V.transpose();
}

ArapEnergy::ArapEnergy(const TetMesh& rest, double stiffness)
    : n_vertices_(rest.n_vertices()), stiffness_(stiffness), elements_(tet_elements(rest)) {
  PLEAT_CHECK(stiffness > 0, "a stiffness is positive");
}

double ArapEnergy::energy(const Positions& positions) const {
  double energy = 0;
  for (const TetElement& element : elements_) {
    const Mat3 F = element.deformation_gradient(positions);
    energy += stiffness_ * element.volume * (F - nearest_rotation(F)).squaredNorm();
  }
  return energy;
}

// The nearest rotation does not change the distance to first order: dE/dF = 2 w V (F - R).
double ArapEnergy::energy_and_gradient(const Positions& positions, Positions& gradient) const {
  gradient.setZero(3, n_vertices_);
  double energy = 0;
  for (const TetElement& element : elements_) {
    const Mat3 F = element.deformation_gradient(positions);
    const Mat3 from_rotation = F - nearest_rotation(F);
    energy += stiffness_ * element.volume * from_rotation.squaredNorm();
    const Eigen::Matrix<double, 3, 4> forces =
        2 * stiffness_ * element.volume * from_rotation * element.to_gradient.transpose();
    for (int k = 0; k < 4; ++k)
      gradient.col(element.tet[static_cast<std::size_t>(k)]) += forces.col(k);
  }
  return energy;
}

SparseMatrix ArapEnergy::hessian(const Positions& positions) const {
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(elements_.size() * 78);  // the lower triangle of 12 x 12
  for (const TetElement& element : elements_) {
    const Mat9 of_gradient =
        stiffness_ * element.volume * distance_hessian(element.deformation_gradient(positions));
    // Row 3 c + r of `columns` is F(r, c): it takes the corner's coordinate r by to_gradient(k, c).
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        Mat3 block = Mat3::Zero();
        for (int c = 0; c < 3; ++c)
          for (int d = 0; d < 3; ++d)
            block += element.to_gradient(a, c) * element.to_gradient(b, d) *
                     of_gradient.block<3, 3>(3 * c, 3 * d);
        const int row = 3 * element.tet[static_cast<std::size_t>(a)];
        const int column = 3 * element.tet[static_cast<std::size_t>(b)];
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            if (row + i >= column + j) entries.emplace_back(row + i, column + j, block(i, j));
      }
  }
  SparseMatrix hessian(3 * n_vertices_, 3 * n_vertices_);
  hessian.setFromTriplets(entries.begin(), entries.end());
  return hessian;
}

}  // namespace pleat
