#include "core/modal/volume_fit.h"

#include "core/base/check.h"
#include "core/linalg/lbfgs.h"
#include "core/linalg/make_linear_solver.h"
#include "core/modal/nearest_rotation.h"

namespace pleat {
namespace {

constexpr int kMostSteps = 1000;
constexpr double kStillness = 1e-8;  // share of the extent

}  // namespace

// While no tetrahedron turns, half of the energy's Hessian is sum_t V G G' + pull W W', with the
// gradients G of the elements and the embedding W.
VolumeFit::VolumeFit(const CarryingVolume& carrying, double attachment)
    : embedding_(carrying.embedding),
      pull_(attachment * total_volume(carrying.volume, carrying.volume.rest_positions) /
            static_cast<double>(carrying.embedding.cols())),
      elements_(tet_elements(carrying.volume)),
      solver_(make_linear_solver(SolverKind::supernodal)) {
  PLEAT_CHECK(attachment > 0, "an attachment pulls");
  SparseMatrix lower = laplacian(carrying.volume.n_vertices(), elements_);
  const SparseMatrix pulled = pull_ * embedding_ * SparseMatrix(embedding_.transpose());
  lower += SparseMatrix(pulled.triangularView<Eigen::Lower>());
  lower.makeCompressed();
  solver_->analyze(lower);
  const SolveReport report = solver_->factorize(lower);
  PLEAT_CHECK(report.ok(), "every part of the volume carries some of the surface");
}

SolveReport VolumeFit::fit(const Positions& wanted, Positions& volume_positions) const {
  PLEAT_CHECK(wanted.cols() == embedding_.cols() && volume_positions.cols() == embedding_.rows(),
              "a place for each vertex of surface and volume");
  DescentProblem problem;
  problem.value = [&](const Positions& x, Positions& gradient) {
    const Positions off = x * embedding_ - wanted;
    gradient = 2 * pull_ * off * embedding_.transpose();
    double value = pull_ * off.squaredNorm();
    for (const TetElement& element : elements_) {
      const Mat3 F = element.deformation_gradient(x);
      const Mat3 strain = F - nearest_rotation(F);
      value += element.volume * strain.squaredNorm();
      element.add_pulls(2 * strain, gradient);
    }
    return value;
  };
  problem.solve = [&](const Positions& gradient) {
    Eigen::MatrixXd moves(gradient.cols(), 3);
    solver_->solve(gradient.transpose(), moves);
    return Positions(moves.transpose() / 2);
  };
  // Where all of the surface was so far off, the pulls would have this energy.
  const double negligible = kStillness * box_diagonal(wanted);
  problem.least_gain = pull_ * static_cast<double>(wanted.cols()) * negligible * negligible;
  problem.most_steps = kMostSteps;
  const DescentEnd end = descend(problem, volume_positions);
  SolveReport report;
  report.iterations = end.steps;
  if (!end.converged) {
    report.status = SolveStatus::not_converged;
    report.message = "the volume still moved after " + std::to_string(end.steps) + " steps";
  }
  return report;
}

}  // namespace pleat
