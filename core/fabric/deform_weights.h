#pragma once

namespace pleat {

/// Weights of the terms that a fabric's deformed shape trades off: none is negative, and their sum
/// is positive; only their ratios count. Those of a measured fabric add up to one.
struct DeformWeights {
  double recovery = 0;  ///< omega_R: back to where it lay
  double stretch = 0;   ///< omega_S: keep lengths
  double bending = 0;   ///< omega_B: keep curvature
};

}  // namespace pleat
