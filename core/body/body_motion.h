#pragma once

#include <string>

#include "core/base/vec.h"

namespace pleat {

/// The motions of a body: angles of its joints [rad] and the path of its pelvis [m].
///
/// Tilt leans forward, obliquity lifts the right side, rotation brings the right side forward;
/// those of thorax and head are measured from the world. Hip, knee, ankle, shoulder and elbow are
/// measured from the segment above them. The path is that of the point midway between the hip
/// joints: its height, how far it is ahead of the mean speed, and how far to the right.
enum class MotionChannel {
  pelvis_tilt,
  pelvis_obliquity,
  pelvis_rotation,
  hip_flexion,
  hip_adduction,
  hip_rotation,
  knee_flexion,
  ankle_dorsiflexion,
  thorax_tilt,
  thorax_obliquity,
  thorax_rotation,
  shoulder_flexion,
  shoulder_abduction,
  elbow_flexion,
  head_rotation,
  pelvis_height,
  pelvis_ahead,
  pelvis_right,
};
constexpr int kMotionChannels = 18;
constexpr int kAngleChannels = 15;  ///< the first ones

using ChannelValues = Eigen::Matrix<double, kMotionChannels, 1>;

/// One column per key, evenly spaced over the cycle; the first follows on the last.
using ChannelKeys = Eigen::Matrix<double, kMotionChannels, Eigen::Dynamic>;

constexpr int kFewestKeys = 4;  ///< fewer do not determine a periodic cubic spline's four pieces

/// A motion that repeats itself. Keys of joints that come in pairs are the right side's.
struct BodyMotion {
  std::string name;
  ChannelKeys keys;
  double cycle_time = 1;     ///< [s], positive
  double forward_speed = 0;  ///< mean over a cycle [m/s]
  double left_phase = 0;     ///< how far the left side is ahead of the right one [cycles]

  /// Throws ContractError unless there are at least kFewestKeys columns and all is finite.
  void validate() const;
};

/// The periodic cubic spline through a motion's keys. Source: Unser, Splines: a perfect fit for
/// signal and image processing, IEEE Signal Processing Magazine 16(6), 1999.
class MotionCurves {
 public:
  explicit MotionCurves(const ChannelKeys& keys);

  /// phase  [cycles], any; the keys are at whole multiples of one over their number.
  ChannelValues at(double phase) const;

 private:
  ChannelKeys coefficients_;  // coefficients of the uniform cubic B-splines centred at the keys
};

}  // namespace pleat
