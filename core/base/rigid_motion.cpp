#include "core/base/rigid_motion.h"

#include <Eigen/Eigenvalues>

#include "core/base/check.h"

namespace pleat {

double RigidMotion::angle() const { return Eigen::AngleAxisd(rotation).angle(); }

Positions RigidMotion::of(const Positions& places) const {
  return (rotation * (places.colwise() - centre)).colwise() + moved_centre;
}

Mat3 half_turn(const Mat3& rotation) {
  return Eigen::Quaterniond::Identity().slerp(0.5, Eigen::Quaterniond(rotation)).toRotationMatrix();
}

/// Maximises sum b.(R a) = q^T N q over rotations R, written as unit quaternions q = (w, v), with
/// S = sum a b^T of the places about their means, a before and b after: q is an eigenvector of
///
///     N = (tr S  d^T; d  S + S^T - tr S I),   d = (S_yz - S_zy, S_zx - S_xz, S_xy - S_yx).
///
/// A small addition to its first entry favours w = cos(angle/2).
RigidMotion nearest_rigid_motion(const PositionsView& before, const PositionsView& after) {
  constexpr double kFavour = 1e-6;  // share of S; turns the result by about as many radians
  PLEAT_CHECK(before.cols() > 0 && before.cols() == after.cols(), "every place goes somewhere");
  RigidMotion motion;
  motion.centre = before.rowwise().mean();
  motion.moved_centre = after.rowwise().mean();
  const Mat3 S =
      (before.colwise() - motion.centre) * (after.colwise() - motion.moved_centre).transpose();
  if (S.isZero(0)) return motion;
  const Vec3 d(S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0));
  Eigen::Matrix4d N;
  N << S.trace() + kFavour * S.norm(), d.transpose(), d,
      S + S.transpose() - S.trace() * Mat3::Identity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(N);
  const Eigen::Vector4d q = solver.eigenvectors().col(3);  // values ascend
  motion.rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  return motion;
}

}  // namespace pleat
