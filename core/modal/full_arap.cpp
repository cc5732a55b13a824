#include "core/modal/full_arap.h"

#include "core/base/check.h"
#include "core/base/rigid_motion.h"
#include "core/linalg/make_linear_solver.h"
#include "core/modal/nearest_rotation.h"

namespace pleat {
namespace {

class FullBlend : public ArapBlend {
 public:
  FullBlend(const std::vector<TetElement>& elements, const Eigen::VectorXd& masses,
            LinearSolver& solver, const Positions& a, const Positions& b)
      : elements_(elements), masses_(masses), solver_(solver) {
    of_a_.reserve(elements.size());
    of_b_.reserve(elements.size());
    for (const TetElement& element : elements) {
      of_a_.push_back(element.deformation_gradient(a));
      of_b_.push_back(element.deformation_gradient(b));
    }
  }

  Distances distances(const ShapeCoordinates& x, ShapeCoordinates& gradient_a,
                      ShapeCoordinates& gradient_b) const override {
    Distances distances{0, 0};
    gradient_a.setZero(3, x.cols());
    gradient_b.setZero(3, x.cols());
    for (std::size_t t = 0; t < elements_.size(); ++t) {
      const Mat3 F = elements_[t].deformation_gradient(x);
      const auto distance = [&](const Mat3& from, ShapeCoordinates& gradient) {
        const Mat3 off = F - nearest_rotation(F * from.transpose()) * from;
        elements_[t].add_pulls(2 * off, gradient);
        return elements_[t].volume * off.squaredNorm();
      };
      distances.from_a += distance(of_a_[t], gradient_a);
      distances.from_b += distance(of_b_[t], gradient_b);
    }
    return distances;
  }

  ShapeCoordinates half_turned() const override {
    Positions pulls = Positions::Zero(3, masses_.size());
    for (std::size_t t = 0; t < elements_.size(); ++t) {
      const Mat3 half = half_turn(nearest_rotation(of_b_[t] * of_a_[t].transpose()));
      elements_[t].add_pulls(0.5 * (half * of_a_[t] + half.transpose() * of_b_[t]), pulls);
    }
    return solve(pulls);
  }

  ShapeCoordinates preconditioned(const ShapeCoordinates& gradient) const override {
    return solve(gradient) / 4;
  }

 private:
  Positions solve(const Positions& pulls) const {
    Eigen::MatrixXd places(pulls.cols(), 3);
    const SolveReport report = solver_.solve(pulls.transpose(), places);
    PLEAT_CHECK(report.ok(), "a volume in one part, held at a vertex, is stiff");
    const Positions x = places.transpose();
    return x.colwise() - (x * masses_).eval();
  }

  const std::vector<TetElement>& elements_;
  const Eigen::VectorXd& masses_;
  LinearSolver& solver_;
  std::vector<Mat3> of_a_, of_b_;  // deformation gradients
};

}  // namespace

FullArap::FullArap(const TetMesh& rest)
    : elements_(tet_elements(rest)),
      masses_(vertex_volumes(rest)),
      solver_(make_linear_solver(SolverKind::supernodal)),
      scale_(3 * masses_.sum()) {
  masses_ /= masses_.sum();
  // Held at its first vertex; where that is matters to nobody, as the pulls are in balance.
  SparseMatrix stiffness = laplacian(rest.n_vertices(), elements_);
  stiffness.coeffRef(0, 0) *= 2;
  solver_->analyze(stiffness);
  PLEAT_CHECK(solver_->factorize(stiffness).ok(), "the volume is in one part");
}

std::unique_ptr<ArapBlend> FullArap::blend(const Positions& a, const Positions& b) const {
  return std::make_unique<FullBlend>(elements_, masses_, *solver_, a, b);
}

}  // namespace pleat
