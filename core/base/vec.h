#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pleat {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// One column per vertex [m], so that memory runs x y z x y z. Also used for velocities [m/s] and
/// forces [N].
using Positions = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Rest coordinates, one column per vertex: along warp, along weft [m].
using RestCoordinates = Eigen::Matrix<double, 2, Eigen::Dynamic>;

}  // namespace pleat
