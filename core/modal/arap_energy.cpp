#include "core/modal/arap_energy.h"

#include <cmath>

#include "core/base/check.h"
#include "core/modal/nearest_rotation.h"

namespace pleat {
namespace {

/// d2/dF2 of min_R |F - R|^2, of the columns of F one below the other: 2 I less 4/(s_i + s_j) in
/// the directions in which R turns,
///
///     t_k = U (e_i e_j' - e_j e_i') V' / sqrt 2.
Mat9 distance_hessian(const Mat3& F) {
  constexpr double kLeastSum = 1e-8;  // keeps off the pole where no rotation is the nearest
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
    element.add_pulls(2 * stiffness_ * from_rotation, gradient);
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
