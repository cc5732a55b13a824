#include "core/body/moving_body.h"

#include <array>
#include <cmath>
#include <utility>

#include "core/base/check.h"

namespace pleat {
namespace {

/// The pelvis's tilt while standing [rad], 10 degrees; the hips are flexed by as much, so that the
/// thighs hang straight.
constexpr double kStandingTilt = 0.17453292519943295;

struct BoneSpec {
  const char* name;
  Bone parent;  // pelvis: itself
  double x, y;  // place of its joint while standing [m]
  double z;     // distance to its own side [m]
};
constexpr std::array<BoneSpec, kBones> kSpecs{{
    {"pelvis", Bone::pelvis, 0, 0.867, 0},
    {"thorax", Bone::pelvis, -0.01, 0.985, 0},
    {"head", Bone::thorax, -0.01, 1.37, 0},
    {"thigh_right", Bone::pelvis, 0, 0.867, 0.085},
    {"thigh_left", Bone::pelvis, 0, 0.867, 0.085},
    {"shank_right", Bone::thigh_right, 0, 0.467, 0.085},
    {"shank_left", Bone::thigh_left, 0, 0.467, 0.085},
    {"foot_right", Bone::shank_right, 0, 0.064, 0.085},
    {"foot_left", Bone::shank_left, 0, 0.064, 0.085},
    {"upper_arm_right", Bone::thorax, -0.01, 1.305, 0.165},
    {"upper_arm_left", Bone::thorax, -0.01, 1.305, 0.165},
    {"forearm_right", Bone::upper_arm_right, -0.01, 1.03, 0.18},
    {"forearm_left", Bone::upper_arm_left, -0.01, 1.03, 0.18},
}};

const BoneSpec& spec(Bone bone) { return kSpecs[static_cast<std::size_t>(bone)]; }

bool is_left(Bone bone) {
  return bone >= Bone::thigh_right &&
         (static_cast<int>(bone) - static_cast<int>(Bone::thigh_right)) % 2 == 1;
}

/// +1 on the right, -1 on the left.
double side(Bone bone) { return is_left(bone) ? -1 : 1; }

double channel(const ChannelValues& values, MotionChannel which) {
  return values[static_cast<int>(which)];
}

Mat3 about_x(double angle) { return Eigen::AngleAxisd(angle, Vec3::UnitX()).toRotationMatrix(); }
Mat3 about_y(double angle) { return Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix(); }
Mat3 about_z(double angle) { return Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix(); }

Mat3 standing_rotation(Bone bone) {
  return bone == Bone::pelvis ? about_z(-kStandingTilt) : Mat3(Mat3::Identity());
}

ChannelValues standing_values() {
  ChannelValues values = ChannelValues::Zero();
  values[static_cast<int>(MotionChannel::pelvis_tilt)] = kStandingTilt;
  values[static_cast<int>(MotionChannel::hip_flexion)] = kStandingTilt;
  values[static_cast<int>(MotionChannel::pelvis_height)] = spec(Bone::pelvis).y;
  return values;
}

/// The smoothest step, w = 10 s^3 - 15 s^4 + 6 s^5, whose first two derivatives are zero at both
/// ends; s = time / duration.
double blend_weight(double s) {
  if (s <= 0) return 0;
  return s >= 1 ? 1 : s * s * s * (10 + s * (6 * s - 15));
}

/// Its integral from 0 to s; s - 1/2 past the end.
double blend_integral(double s) {
  if (s <= 0) return 0;
  return s >= 1 ? s - 0.5 : s * s * s * s * (2.5 + s * (s - 3));
}

/// A body's angles at one time.
struct Posture {
  ChannelValues right, left;
  double way = 0;  // walked by the mean speed [m]
};

Mat3 trunk_rotation(const ChannelValues& v, MotionChannel tilt) {
  const int first = static_cast<int>(tilt);  // obliquity and rotation come next
  return about_y(v[first + 2]) * about_x(-v[first + 1]) * about_z(-v[first]);
}

/// Turns the parent's axes into the bone's; thorax and head are turned from the world's.
Mat3 joint_rotation(Bone bone, const Posture& posture) {
  const ChannelValues& v = is_left(bone) ? posture.left : posture.right;
  const double s = side(bone);
  switch (bone) {
    case Bone::pelvis:
      return trunk_rotation(v, MotionChannel::pelvis_tilt);
    case Bone::thorax:
      return trunk_rotation(v, MotionChannel::thorax_tilt);
    case Bone::head:
      return about_y(channel(v, MotionChannel::head_rotation));
    case Bone::thigh_right:
    case Bone::thigh_left:
      return about_z(channel(v, MotionChannel::hip_flexion)) *
             about_x(s * channel(v, MotionChannel::hip_adduction)) *
             about_y(s * channel(v, MotionChannel::hip_rotation));
    case Bone::shank_right:
    case Bone::shank_left:
      return about_z(-channel(v, MotionChannel::knee_flexion));
    case Bone::foot_right:
    case Bone::foot_left:
      return about_z(channel(v, MotionChannel::ankle_dorsiflexion));
    case Bone::upper_arm_right:
    case Bone::upper_arm_left:
      return about_z(channel(v, MotionChannel::shoulder_flexion)) *
             about_x(-s * channel(v, MotionChannel::shoulder_abduction));
    case Bone::forearm_right:
    case Bone::forearm_left:
      return about_z(channel(v, MotionChannel::elbow_flexion));
  }
  return Mat3::Identity();
}

bool turns_from_world(Bone bone) { return bone <= Bone::head; }

Pose bone_pose(Bone bone, const Posture& posture) {
  Mat3 axes = joint_rotation(bone, posture);
  Vec3 joint(posture.way + channel(posture.right, MotionChannel::pelvis_ahead),
             channel(posture.right, MotionChannel::pelvis_height),
             channel(posture.right, MotionChannel::pelvis_right));
  if (bone != Bone::pelvis) {
    const Bone parent = spec(bone).parent;
    const Pose above = bone_pose(parent, posture);
    joint = above * standing_joint(bone);
    if (!turns_from_world(bone)) axes = above.rotation * standing_rotation(parent) * axes;
  }
  const Mat3 turned = axes * standing_rotation(bone).transpose();
  return {turned, joint - turned * standing_joint(bone)};
}

const BodyMotion& validated(const BodyMotion& motion) {
  motion.validate();
  return motion;
}

class BoneFrame : public MovingFrame {
 public:
  BoneFrame(std::shared_ptr<const MovingBody> body, Bone bone)
      : body_(std::move(body)), bone_(bone) {}
  Pose pose(double time) const override { return body_->pose(bone_, time); }

 private:
  std::shared_ptr<const MovingBody> body_;
  Bone bone_;
};

}  // namespace

const char* bone_name(Bone bone) { return spec(bone).name; }

bool is_below_waist(Bone bone) {
  return bone == Bone::pelvis || (bone >= Bone::thigh_right && bone <= Bone::foot_left);
}

Vec3 standing_joint(Bone bone) { return {spec(bone).x, spec(bone).y, side(bone) * spec(bone).z}; }

MovingBody::MovingBody(const BodyMotion& motion, const Playback& playback)
    : curves_(validated(motion).keys),
      cycle_time_(motion.cycle_time),
      forward_speed_(motion.forward_speed),
      left_phase_(motion.left_phase),
      playback_(playback) {
  PLEAT_CHECK(playback.time_scale > 0 && std::isfinite(playback.time_scale),
              "motions are played forward");
  PLEAT_CHECK(playback.blend_time > 0 && std::isfinite(playback.blend_time),
              "a motion is blended in over some time");
}

Pose MovingBody::pose(Bone bone, double time) const {
  const double weight = blend_weight(time / playback_.blend_time);
  // The remainder is exact, so hours into a walk the phase is as good as the time itself.
  const double phase = std::fmod(playback_.time_scale * time, cycle_time_) / cycle_time_;
  const ChannelValues standing = standing_values();
  const auto blended = [&](const ChannelValues& moving) -> ChannelValues {
    // Legs bent by an angle lower the pelvis by its square.
    ChannelValues change = weight * (moving - standing);
    change[static_cast<int>(MotionChannel::pelvis_height)] *= weight;
    return standing + change;
  };
  const Posture posture{blended(curves_.at(phase)), blended(curves_.at(phase + left_phase_)),
                        forward_speed_ * playback_.time_scale * playback_.blend_time *
                            blend_integral(time / playback_.blend_time)};
  return bone_pose(bone, posture);
}

std::shared_ptr<const MovingFrame> bone_frame(std::shared_ptr<const MovingBody> body, Bone bone) {
  PLEAT_CHECK(body != nullptr, "a frame has a body");
  return std::make_shared<BoneFrame>(std::move(body), bone);
}

}  // namespace pleat
