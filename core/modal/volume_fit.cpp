#include "core/modal/volume_fit.h"

#include "core/base/check.h"
#include "core/modal/arap_energy.h"

namespace pleat {
namespace {

constexpr int kMostTurns = 2000;
constexpr double kStillness = 1e-8;  // of the extent

}  // namespace

// With the places X (3 x n), gradients G of the elements and the embedding W, the energy is least
// for given rotations where
//
//     X (sum_t V G G' + pull W W') = sum_t V R G' + pull wanted W'.
VolumeFit::VolumeFit(const CarryingVolume& carrying, double attachment)
    : embedding_(carrying.embedding),
      pull_(attachment * total_volume(carrying.volume, carrying.volume.rest_positions) /
            static_cast<double>(carrying.embedding.cols())),
      elements_(tet_elements(carrying.volume)),
      solver_(make_linear_solver(SolverKind::supernodal)) {
  PLEAT_CHECK(attachment > 0, "an attachment pulls");
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(10 * elements_.size());
  for (const TetElement& element : elements_) {
    const Eigen::Matrix4d block =
        element.volume * element.to_gradient * element.to_gradient.transpose();
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        const int row = element.tet[static_cast<std::size_t>(a)];
        const int column = element.tet[static_cast<std::size_t>(b)];
        if (row >= column) entries.emplace_back(row, column, block(a, b));
      }
  }
  SparseMatrix lower(carrying.volume.n_vertices(), carrying.volume.n_vertices());
  lower.setFromTriplets(entries.begin(), entries.end());
  const SparseMatrix pulled = pull_ * embedding_ * SparseMatrix(embedding_.transpose());
  lower += SparseMatrix(pulled.triangularView<Eigen::Lower>());
  lower.makeCompressed();
  solver_->analyze(lower);
  const SolveReport report = solver_->factorize(lower);
  PLEAT_CHECK(report.ok(), "every part of the volume carries some of the surface");
}

SolveReport VolumeFit::fit(const Positions& wanted, Positions& volume_positions) const {
  const Eigen::Index n = embedding_.rows();
  PLEAT_CHECK(wanted.cols() == embedding_.cols() && volume_positions.cols() == n,
              "a place for each vertex of surface and volume");
  const Eigen::MatrixXd pulls = pull_ * (embedding_ * wanted.transpose());
  const double extent = box_diagonal(wanted);
  Eigen::MatrixXd rhs(n, 3);
  Eigen::MatrixXd places = volume_positions.transpose();
  SolveReport report;
  while (report.iterations < kMostTurns) {
    ++report.iterations;
    rhs = pulls;
    for (const TetElement& element : elements_) {
      const Mat3 R = nearest_rotation(element.deformation_gradient(volume_positions));
      const Eigen::Matrix<double, 4, 3> share =
          element.volume * element.to_gradient * R.transpose();
      for (int k = 0; k < 4; ++k) rhs.row(element.tet[static_cast<std::size_t>(k)]) += share.row(k);
    }
    if (SolveReport solved = solver_->solve(rhs, places); solved.ends_run()) return solved;
    const double way = (places.transpose() - volume_positions).colwise().norm().maxCoeff() / extent;
    volume_positions = places.transpose();
    report.relative_residual = way;
    if (way <= kStillness) return report;
  }
  report.status = SolveStatus::not_converged;
  report.message = "the volume still moved by " + std::to_string(report.relative_residual) +
                   " of its extent in the last turn";
  return report;
}

}  // namespace pleat
