#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pleat {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Vec9 = Eigen::Matrix<double, 9, 1>;
using Mat9 = Eigen::Matrix<double, 9, 9>;

/// One column per vertex [m], so that memory runs x y z x y z. Also used for velocities [m/s] and
/// forces [N].
using Positions = Eigen::Matrix<double, 3, Eigen::Dynamic>;
/// Arguments: `const PositionsView&` and `const VectorView&` are read, a PositionsRef is written.
using PositionsView = Eigen::Ref<const Positions>;
using PositionsRef = Eigen::Ref<Positions>;
using VectorView = Eigen::Ref<const Eigen::VectorXd>;

/// Rest coordinates, one column per vertex: along warp, along weft [m].
using RestCoordinates = Eigen::Matrix<double, 2, Eigen::Dynamic>;

/// Views the columns as one long vector, as linear solvers take them.
inline Eigen::Map<Eigen::VectorXd> flat(Positions& columns) {
  return {columns.data(), columns.size()};
}
inline Eigen::Map<const Eigen::VectorXd> flat(const Positions& columns) {
  return {columns.data(), columns.size()};
}

// Plain loops over all vertices or edges after every step call these: a build for size makes calls
// of Eigen's expressions, and none of these.
/// |x_i|^2.
inline double squared_norm(const Positions& x, Eigen::Index i) {
  const double* const c = x.data() + 3 * i;
  return c[0] * c[0] + (c[1] * c[1] + c[2] * c[2]);
}
/// |x_i - y|^2.
inline double squared_distance(const Positions& x, Eigen::Index i, const double* y) {
  const double* const c = x.data() + 3 * i;
  const double dx = c[0] - y[0];
  const double dy = c[1] - y[1];
  const double dz = c[2] - y[2];
  return dx * dx + (dy * dy + dz * dz);
}
/// |x_i - x_j|^2.
inline double squared_distance(const Positions& x, Eigen::Index i, Eigen::Index j) {
  return squared_distance(x, i, x.data() + 3 * j);
}

/// Diagonal of the box around the columns [m]; there must be one.
inline double box_diagonal(const Positions& x) {
  return (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
}

}  // namespace pleat
