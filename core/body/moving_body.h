#pragma once

#include <memory>

#include "core/base/pose.h"
#include "core/body/body_motion.h"

namespace pleat {

/// The rigid parts of a body. A pair's right one stands before its left one.
enum class Bone {
  pelvis,
  thorax,
  head,
  thigh_right,
  thigh_left,
  shank_right,
  shank_left,
  foot_right,
  foot_left,
  upper_arm_right,
  upper_arm_left,
  forearm_right,
  forearm_left,
};
constexpr int kBones = 13;

/// "thigh_right"
const char* bone_name(Bone bone);

bool is_below_waist(Bone bone);

/// The joint that a bone hangs from while the body stands [m]: x forward, y up from the floor, z to
/// the right, the hips midway over the origin; a woman of 1.635 m.
Vec3 standing_joint(Bone bone);

/// How a motion is played.
struct Playback {
  double time_scale = 1;  ///< positive; 2 is double speed
  double blend_time = 1;  ///< time from standing into the motion [s], positive
};

/// A body that stands at time 0 with straight limbs, and before it, and goes over into a motion by
/// a weight that is twice continuously differentiable. The weight also multiplies the forward
/// speed, whose integral is the way.
///
/// Source: the chain of joints and its signs as docs/methods/body.md gives them.
class MovingBody {
 public:
  /// Throws ContractError as BodyMotion::validate does, and unless both of `playback` are positive.
  MovingBody(const BodyMotion& motion, const Playback& playback);

  /// How a bone has moved since time 0 [s].
  Pose pose(Bone bone, double time) const;

  /// The place of the joint that the bone hangs from [m].
  Vec3 joint(Bone bone, double time) const { return pose(bone, time) * standing_joint(bone); }

 private:
  MotionCurves curves_;
  double cycle_time_;     // [s]
  double forward_speed_;  // [m/s]
  double left_phase_;     // [cycles]
  Playback playback_;
};

/// A bone as something that pins and solids follow. `body` is not null.
std::shared_ptr<const MovingFrame> bone_frame(std::shared_ptr<const MovingBody> body, Bone bone);

}  // namespace pleat
