#include "core/modal/shape_space.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "core/base/check.h"
#include "core/linalg/orthonormal.h"

namespace pleat {
namespace {

Eigen::MatrixXd affine_functions(const Positions& rest, const Eigen::VectorXd& root_masses) {
  Eigen::MatrixXd affine(rest.cols(), kAffineFunctions);
  affine.col(0).setOnes();
  affine.rightCols<3>() = rest.transpose().rowwise() - rest.rowwise().mean().transpose();
  affine = root_masses.asDiagonal() * affine;
  affine = orthonormal_in_order(affine);
  PLEAT_CHECK(affine.colwise().squaredNorm().minCoeff() > 0, "a shape space is of a volume");
  return affine;
}

/// The coordinates of all modes but the rigid ones, each mode with unit energy over that of the
/// softest: one function per column.
Eigen::MatrixXd mode_functions(const std::vector<Modes>& modes,
                               const Eigen::VectorXd& root_masses) {
  const Eigen::Index n = root_masses.size();
  Eigen::Index count = 0;
  double softest = std::numeric_limits<double>::infinity();
  for (const Modes& of_one : modes) {
    for (Eigen::Index m = of_one.n_rigid; m < of_one.size(); ++m) {
      if (is_costless(of_one, m)) continue;
      count += 3;
      softest = std::min(softest, of_one.stiffness[m]);
    }
  }
  Eigen::MatrixXd functions(n, count);
  Eigen::Index column = 0;
  for (const Modes& of_one : modes)
    for (Eigen::Index m = of_one.n_rigid; m < of_one.size(); ++m) {
      if (is_costless(of_one, m)) continue;
      const Eigen::Map<const Positions> shape(of_one.shapes.col(m).data(), 3, n);
      const double size = std::sqrt(softest / of_one.stiffness[m]);
      for (int axis = 0; axis < 3; ++axis)
        functions.col(column++) = size * root_masses.cwiseProduct(shape.row(axis).transpose());
    }
  return functions;
}

/// Directions that columns of functions have most in common, orthonormal, the heaviest first.
struct CommonDirections {
  Eigen::MatrixXd functions;  // one per column
  Eigen::VectorXd weights;    // singular values
};

/// At most `room` of them; none lighter than `tolerance` of the heaviest.
CommonDirections common_directions(const Eigen::MatrixXd& columns, Eigen::Index room,
                                   double tolerance) {
  const Eigen::Index m = columns.cols();
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(m, m);
  products.selfadjointView<Eigen::Lower>().rankUpdate(columns.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(products);
  const Eigen::VectorXd squares = eigen.eigenvalues().reverse();  // now they descend
  const double least = tolerance * tolerance * squares[0];
  Eigen::Index count = 0;
  while (count < std::min(room, m) && squares[count] > least) ++count;
  CommonDirections common;
  common.weights = squares.head(count).cwiseSqrt();
  common.functions = columns * eigen.eigenvectors().rowwise().reverse().leftCols(count) *
                     common.weights.cwiseInverse().asDiagonal();
  return common;
}

/// A base that grows by what others add to it.
class GrowingSpace {
 public:
  explicit GrowingSpace(const Eigen::MatrixXd& base)
      : base_(base), weights_(Eigen::VectorXd::Zero(base.cols())) {}

  void add(Eigen::MatrixXd columns, Eigen::Index most, double tolerance) {
    if (columns.cols() == 0 || base_.cols() >= most) return;
    columns -= base_ * (base_.transpose() * columns).eval();
    const CommonDirections common = common_directions(columns, most - base_.cols(), tolerance);
    const Eigen::Index before = base_.cols();
    base_.conservativeResize(Eigen::NoChange, before + common.functions.cols());
    base_.rightCols(common.functions.cols()) = common.functions;
    weights_.conservativeResize(base_.cols());
    weights_.tail(common.weights.size()) = common.weights;
  }

  const Eigen::MatrixXd& base() const { return base_; }
  const Eigen::VectorXd& weights() const { return weights_; }

 private:
  Eigen::MatrixXd base_;
  Eigen::VectorXd weights_;
};

/// The squares of singular values are known to 16 digits, they themselves to eight.
constexpr double kLeastShare = 1e-7;

}  // namespace

ShapeSpace shape_space(const Positions& rest, const Eigen::VectorXd& masses,
                       const std::vector<Modes>& modes, const std::vector<Positions>& exact,
                       int most, double tolerance) {
  PLEAT_CHECK(masses.size() == rest.cols() && masses.minCoeff() > 0, "every vertex has mass");
  PLEAT_CHECK(most >= kAffineFunctions, "a space has the affine motions");
  const Eigen::VectorXd root_masses = masses.cwiseSqrt();
  GrowingSpace growing(affine_functions(rest, root_masses));
  Eigen::MatrixXd of_exact(rest.cols(), 3 * static_cast<Eigen::Index>(exact.size()));
  for (std::size_t e = 0; e < exact.size(); ++e)
    of_exact.middleCols<3>(3 * static_cast<Eigen::Index>(e)) =
        root_masses.asDiagonal() * exact[e].transpose();
  growing.add(of_exact, kAffineFunctions + of_exact.cols(), kLeastShare);
  growing.add(mode_functions(modes, root_masses), most, std::max(tolerance, kLeastShare));

  ShapeSpace space;
  space.functions =
      (root_masses.cwiseInverse().asDiagonal() * orthonormal_in_order(growing.base())).transpose();
  space.weights = growing.weights();
  space.masses = masses;
  return space;
}

}  // namespace pleat
