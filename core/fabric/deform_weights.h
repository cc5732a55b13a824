#pragma once

namespace pleat {

/// What a fabric's deformed shape trades off, relative to one another: none is negative, and their
/// sum is positive. Those of a measured fabric add up to one.
struct DeformWeights {
  double recovery = 0;  ///< omega_R: back to where it lay
  double stretch = 0;   ///< omega_S: keep lengths
  double bending = 0;   ///< omega_B: keep curvature
};

}  // namespace pleat
