#pragma once

#include "core/base/vec.h"

namespace pleat {

/// F = U diag(s) V' with rotations U and V; the last of s is negative where F turns inside out.
struct RotationSvd {
  Mat3 U, V;
  Vec3 s;
};

RotationSvd rotation_svd(const Mat3& F);

/// The rotation nearest to F, without reflection even where F turns inside out. Source: Higham,
/// Computing the polar decomposition, SIAM J. Scientific and Statistical Computing 7, 1986.
Mat3 nearest_rotation(const Mat3& F);

}  // namespace pleat
