#include "core/modal/reduced_arap.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/base/check.h"
#include "core/base/rigid_motion.h"
#include "core/modal/nearest_rotation.h"
#include "core/modal/tet_element.h"

namespace pleat {
namespace {

using Key = ReducedArap::Key;

class ReducedBlend : public ArapBlend {
 public:
  ReducedBlend(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& compliance, const Key& a,
               const Key& b)
      : stiffness_(stiffness), compliance_(compliance), a_(a), b_(b) {}

  // |F(x) - R F(a)|^2 = |F(x)|^2 - 2 R : F(x) F(a)' + |F(a)|^2, summed over each cluster.
  Distances distances(const ShapeCoordinates& x, ShapeCoordinates& gradient_a,
                      ShapeCoordinates& gradient_b) const override {
    const ShapeCoordinates stiff = x * stiffness_;
    const double square = stiff.cwiseProduct(x).sum();
    const auto distance = [&](const Key& from, ShapeCoordinates& gradient) {
      Positions moments = x * from.pulls;
      double turned = 0;
      for (Eigen::Index column = 0; column < moments.cols(); column += 3) {
        auto moment = moments.middleCols<3>(column);
        const Mat3 R = nearest_rotation(moment);
        turned += R.cwiseProduct(moment).sum();
        moment = R;
      }
      gradient = 2 * stiff;
      gradient.noalias() -= 2 * moments * from.pulls.transpose();
      return std::max(square + from.square - 2 * turned, 0.0);
    };
    return {distance(a_, gradient_a), distance(b_, gradient_b)};
  }

  ShapeCoordinates half_turned() const override {
    const std::vector<Mat3> turns = ReducedArap::rotations(a_, b_.shape);
    Positions halves(3, 3 * static_cast<Eigen::Index>(turns.size()));
    Positions backwards = halves;
    for (std::size_t c = 0; c < turns.size(); ++c) {
      const auto column = 3 * static_cast<Eigen::Index>(c);
      halves.middleCols<3>(column) = half_turn(turns[c]);
      backwards.middleCols<3>(column) = halves.middleCols<3>(column).transpose();
    }
    return 0.5 * (halves * a_.pulls.transpose() + backwards * b_.pulls.transpose()) * compliance_;
  }

  ShapeCoordinates preconditioned(const ShapeCoordinates& gradient) const override {
    return gradient * (compliance_ / 4);
  }

 private:
  const Eigen::MatrixXd& stiffness_;
  const Eigen::MatrixXd& compliance_;
  const Key& a_;
  const Key& b_;
};

}  // namespace

ReducedArap::ReducedArap(const TetMesh& rest, const ShapeSpace& space,
                         const std::vector<int>& cluster_of_tet)
    : scale_(3 * total_volume(rest, rest.rest_positions)) {
  PLEAT_CHECK(cluster_of_tet.size() == rest.tets.size() &&
                  space.functions.cols() == rest.n_vertices() && !rest.tets.empty(),
              "a cluster for each tetrahedron, a value of each function for each vertex");
  const int k = space.size();
  const int n_clusters = 1 + *std::max_element(cluster_of_tet.begin(), cluster_of_tet.end());
  stiffnesses_.assign(static_cast<std::size_t>(n_clusters), Eigen::MatrixXd::Zero(k, k));
  const std::vector<TetElement> elements = tet_elements(rest);
  Eigen::MatrixXd gradient(k, 3);
  for (std::size_t t = 0; t < elements.size(); ++t) {
    const TetElement& element = elements[t];
    gradient.setZero();
    for (int corner = 0; corner < 4; ++corner)
      gradient.noalias() += space.functions.col(element.tet[static_cast<std::size_t>(corner)]) *
                            element.to_gradient.row(corner);
    gradient *= std::sqrt(element.volume);
    stiffnesses_[static_cast<std::size_t>(cluster_of_tet[t])]
        .selfadjointView<Eigen::Lower>()
        .rankUpdate(gradient);
  }
  stiffness_ = Eigen::MatrixXd::Zero(k, k);
  for (Eigen::MatrixXd& of_cluster : stiffnesses_) {
    of_cluster.triangularView<Eigen::StrictlyUpper>() = of_cluster.transpose();
    stiffness_ += of_cluster;
  }
  // The first function is constant: it has no gradient.
  compliance_ = Eigen::MatrixXd::Zero(k, k);
  compliance_.bottomRightCorner(k - 1, k - 1) = stiffness_.bottomRightCorner(k - 1, k - 1)
                                                    .ldlt()
                                                    .solve(Eigen::MatrixXd::Identity(k - 1, k - 1));
}

ReducedArap::Key ReducedArap::key(const ShapeCoordinates& shape) const {
  Key key{shape, {}, (shape * stiffness_).cwiseProduct(shape).sum()};
  key.pulls.resize(shape.cols(), 3 * n_clusters());
  for (int c = 0; c < n_clusters(); ++c)
    key.pulls.middleCols<3>(3 * c).noalias() =
        stiffnesses_[static_cast<std::size_t>(c)] * shape.transpose();
  return key;
}

std::unique_ptr<ArapBlend> ReducedArap::blend(const Key& a, const Key& b) const {
  return std::make_unique<ReducedBlend>(stiffness_, compliance_, a, b);
}

Key ReducedArap::turned(const Key& key, const Mat3& rotation) {
  Key result{rotation * key.shape, key.pulls, key.square};
  for (Eigen::Index column = 0; column < result.pulls.cols(); column += 3)
    result.pulls.middleCols<3>(column) = key.pulls.middleCols<3>(column) * rotation.transpose();
  return result;
}

std::vector<Mat3> ReducedArap::rotations(const Key& from, const ShapeCoordinates& to) {
  const Positions moments = to * from.pulls;
  std::vector<Mat3> turns(static_cast<std::size_t>(moments.cols() / 3));
  for (std::size_t c = 0; c < turns.size(); ++c)
    turns[c] = nearest_rotation(moments.middleCols<3>(3 * static_cast<Eigen::Index>(c)));
  return turns;
}

}  // namespace pleat
