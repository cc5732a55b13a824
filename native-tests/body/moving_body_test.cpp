#include "core/body/moving_body.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/check.h"
#include "core/base/motion.h"
#include "core/files/motion_file.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 4> kMotionNames = {"walk_normal", "walk_fast", "squat", "turn"};

std::string motion_text(const std::string& name) {
  return repository_file("assets/motions/" + name + ".json");
}

BodyMotion motion_named(const std::string& name) { return read_motion(motion_text(name)); }

MovingBody body_named(const std::string& name, const Playback& playback = {}) {
  return {motion_named(name), playback};
}

std::array<Bone, kBones> all_bones() {
  std::array<Bone, kBones> bones{};
  for (int i = 0; i < kBones; ++i) bones[static_cast<std::size_t>(i)] = static_cast<Bone>(i);
  return bones;
}

/// A point that moves with a bone, given by its place while the body stands [m].
Vec3 carried(const MovingBody& body, Bone bone, const Vec3& standing, double time) {
  return body.pose(bone, time) * standing;
}

/// Places on the soles while the body stands [m].
struct SolePoint {
  Bone foot;
  Vec3 standing;
};

std::vector<SolePoint> heels_and_balls() {
  return {{Bone::foot_right, {-0.05, 0, 0.085}},
          {Bone::foot_right, {0.13, 0, 0.09}},
          {Bone::foot_left, {-0.05, 0, -0.085}},
          {Bone::foot_left, {0.13, 0, -0.09}}};
}

/// Joints by the chain of rotations written out, from the raw keys of a motion's file.
class RawBody {
 public:
  RawBody(json motion, int key) : motion_(std::move(motion)), key_(key) {}

  Vec3 pelvis(double mean_way) const {
    const json& path = motion_["pelvis_path"];
    return {mean_way + at(path["ahead_m"], 0), at(path["height_m"], 0), at(path["right_m"], 0)};
  }

  /// The joints from hip to ball of foot.
  std::array<Vec3, 5> leg(double s, double mean_way) const {
    const Mat3 thigh = trunk("pelvis") * rz(angle("hip_flexion", s)) *
                       rx(s * angle("hip_adduction", s)) * ry(s * angle("hip_rotation", s));
    const Mat3 shank = thigh * rz(-angle("knee_flexion", s));
    const Mat3 foot = shank * rz(angle("ankle_dorsiflexion", s));
    const Vec3 hip = pelvis(mean_way) + trunk("pelvis") * Vec3(0, 0, s * 0.085);
    const Vec3 knee = hip + thigh * Vec3(0, -0.4, 0);
    const Vec3 ankle = knee + shank * Vec3(0, -0.403, 0);
    return {hip, knee, ankle, ankle + foot * Vec3(-0.05, -0.064, 0),
            ankle + foot * Vec3(0.13, -0.064, s * 0.005)};
  }

  /// The joints from shoulder to wrist. In a pelvis tilted by ten degrees the lumbar joint stands
  /// 0.118 m above the hips and 0.01 m behind them.
  std::array<Vec3, 3> arm(double s, double mean_way) const {
    const Vec3 lumbar = pelvis(mean_way) + trunk("pelvis") * rz(kPi / 18) * Vec3(-0.01, 0.118, 0);
    const Mat3 upper = trunk("thorax") * rz(angle("shoulder_flexion", s)) *
                       rx(-s * angle("shoulder_abduction", s));
    const Mat3 lower = upper * rz(angle("elbow_flexion", s));
    const Vec3 shoulder = lumbar + trunk("thorax") * Vec3(0, 0.32, s * 0.165);
    const Vec3 elbow = shoulder + upper * Vec3(0, -0.275, s * 0.015);
    return {shoulder, elbow, elbow + lower * Vec3(0, -0.24, 0)};
  }

 private:
  static Mat3 rx(double a) {
    return (Mat3() << 1, 0, 0, 0, std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a))
        .finished();
  }
  static Mat3 ry(double a) {
    return (Mat3() << std::cos(a), 0, std::sin(a), 0, 1, 0, -std::sin(a), 0, std::cos(a))
        .finished();
  }
  static Mat3 rz(double a) {
    return (Mat3() << std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1)
        .finished();
  }

  double at(const json& channel, int shift) const {
    if (channel.is_number()) return channel;
    const auto n = static_cast<int>(channel.size());
    return channel[static_cast<std::size_t>((key_ + shift) % n)];
  }

  double angle(const std::string& name, double s) const {
    const json& channel = motion_["angles"][name + "_rad"];
    const double n = channel.is_number() ? 0 : static_cast<double>(channel.size());
    const double ahead = s < 0 ? motion_["left_phase_cycles"].get<double>() : 0;
    return at(channel, static_cast<int>(std::lround(ahead * n)));
  }

  Mat3 trunk(const std::string& part) const {
    return ry(angle(part + "_rotation", 1)) * rx(-angle(part + "_obliquity", 1)) *
           rz(-angle(part + "_tilt", 1));
  }

  json motion_;
  int key_;
};

}  // namespace

TEST_CASE("moving body: at time 0 and before nothing has moved", "[figure]") {
  const std::string name = GENERATE(from_range(kMotionNames));
  CAPTURE(name);
  const MovingBody body = body_named(name);
  for (const Bone bone : all_bones()) {
    CAPTURE(bone_name(bone));
    for (const double time : {0.0, -0.3}) {
      const Pose pose = body.pose(bone, time);
      CHECK((pose.rotation - Mat3::Identity()).norm() < 1e-15);
      CHECK(pose.translation.norm() < 1e-15);
    }
  }
}

TEST_CASE("moving body: joints are where the chain of rotations puts the file's keys", "[figure]") {
  const std::string name = GENERATE(from_range(kMotionNames));
  const int key = GENERATE(0, 7, 23, 49);
  CAPTURE(name, key);
  const BodyMotion motion = motion_named(name);
  const MovingBody body(motion, {});
  const RawBody raw(json::parse(motion_text(name)), key);
  // The time is in the third cycle; half of the first second's way is lost to blending the motion
  // in.
  const double time = (3 + key / 50.0) * motion.cycle_time;
  const double way = motion.forward_speed * (time - 0.5);
  CHECK((body.joint(Bone::pelvis, time) - raw.pelvis(way)).norm() < 1e-9);
  for (const double s : {1.0, -1.0}) {
    CAPTURE(s);
    const auto sided = [&](Bone right) {
      return s > 0 ? right : static_cast<Bone>(static_cast<int>(right) + 1);
    };
    const auto [hip, knee, ankle, heel, ball] = raw.leg(s, way);
    CHECK((body.joint(sided(Bone::thigh_right), time) - hip).norm() < 1e-9);
    CHECK((body.joint(sided(Bone::shank_right), time) - knee).norm() < 1e-9);
    CHECK((body.joint(sided(Bone::foot_right), time) - ankle).norm() < 1e-9);
    const Bone foot = sided(Bone::foot_right);
    CHECK((carried(body, foot, {-0.05, 0, s * 0.085}, time) - heel).norm() < 1e-9);
    CHECK((carried(body, foot, {0.13, 0, s * 0.09}, time) - ball).norm() < 1e-9);
    const auto [shoulder, elbow, wrist] = raw.arm(s, way);
    CHECK((body.joint(sided(Bone::upper_arm_right), time) - shoulder).norm() < 1e-9);
    CHECK((body.joint(sided(Bone::forearm_right), time) - elbow).norm() < 1e-9);
    const Bone forearm = sided(Bone::forearm_right);
    CHECK((carried(body, forearm, {-0.01, 0.79, s * 0.18}, time) - wrist).norm() < 1e-9);
  }
}

TEST_CASE("moving body: neighbouring bones stay joined", "[figure]") {
  const MovingBody body = body_named("walk_fast");
  const std::array<std::array<Bone, 2>, 7> joined = {
      {{Bone::pelvis, Bone::thorax},
       {Bone::thorax, Bone::head},
       {Bone::pelvis, Bone::thigh_left},
       {Bone::thigh_left, Bone::shank_left},
       {Bone::shank_right, Bone::foot_right},
       {Bone::thorax, Bone::upper_arm_left},
       {Bone::upper_arm_right, Bone::forearm_right}}};
  for (const auto& [above, below] : joined)
    CHECK((carried(body, above, standing_joint(below), 0.77) - body.joint(below, 0.77)).norm() <
          1e-14);
}

TEST_CASE("moving body: a walking body's lowest sole is on the floor at every key", "[figure]") {
  const auto name = GENERATE("walk_normal", "walk_fast");
  const int key = GENERATE(range(0, 50));
  CAPTURE(name, key);
  const BodyMotion motion = motion_named(name);
  const MovingBody body(motion, {});
  const double time = (2 + key / 50.0) * motion.cycle_time;
  double lowest = 1;
  for (const SolePoint& point : heels_and_balls())
    lowest = std::min(lowest, carried(body, point.foot, point.standing, time).y());
  // The heights are rounded to 0.1 mm and were made for legs longer by 0.4 mm.
  CHECK(std::abs(lowest) < 1.5e-3);
}

TEST_CASE("moving body: walking soles sink in by 45 mm at most, blending included", "[figure]") {
  const auto name = GENERATE("walk_normal", "walk_fast");
  const double time_scale = GENERATE(1, 2);
  CAPTURE(name, time_scale);
  const MovingBody body = body_named(name, {time_scale, 1});
  double lowest = 1;
  for (int i = 0; i < 1000; ++i)
    for (const SolePoint& point : heels_and_balls())
      lowest = std::min(lowest, carried(body, point.foot, point.standing, i / 250.0).y());
  CHECK(lowest > -0.045);
}

TEST_CASE("moving body: the feet stay within 15 mm in a squat and a turn", "[figure]") {
  const auto name = GENERATE("squat", "turn");
  CAPTURE(name);
  const MovingBody body = body_named(name);
  double farthest = 0;
  for (int i = 0; i < 1500; ++i)
    for (const SolePoint& point : heels_and_balls())
      farthest = std::max(
          farthest, (carried(body, point.foot, point.standing, i / 250.0) - point.standing).norm());
  CHECK(farthest < 0.015);
}

TEST_CASE("moving body: acceleration does not jump at the start nor where the motion is reached",
          "[figure]") {
  const std::string name = GENERATE(from_range(kMotionNames));
  const double at = GENERATE(0.0, 0.8);
  CAPTURE(name, at);
  const MovingBody body = body_named(name, {1, 0.8});
  const Vec3 wrist(-0.01, 0.79, 0.18);
  const auto acceleration = [&](double time, double step) -> Vec3 {
    const auto place = [&](double t) { return carried(body, Bone::forearm_right, wrist, t); };
    return (place(time + step) - 2 * place(time) + place(time - step)) / (step * step);
  };
  const auto jump = [&](double step) -> double {
    return (acceleration(at + step, step) - acceleration(at - step, step)).norm();
  };
  // The jump of a continuous acceleration is proportional to the step.
  CHECK(jump(2.5e-4) < 0.6 * jump(5e-4));
}

TEST_CASE("moving body: the way is the integral of the blended speed", "[figure]") {
  const BodyMotion motion = motion_named("walk_normal");
  BodyMotion standing = motion;  // has the same speed without swaying
  standing.keys.setZero();
  const MovingBody body(standing, {1.5, 0.8});
  const double speed = 1.5 * motion.forward_speed;
  // By symmetry of the blend, half the speed is the mean, and it has its mean at half time.
  CHECK(body.joint(Bone::pelvis, 0.8).x() == Approx(speed * 0.4).epsilon(1e-14));
  CHECK(body.joint(Bone::pelvis, 3.8).x() == Approx(speed * 3.4).epsilon(1e-14));
  const double step = 1e-5;
  const double half_time =
      (body.joint(Bone::pelvis, 0.4 + step).x() - body.joint(Bone::pelvis, 0.4 - step).x()) /
      (2 * step);
  CHECK(half_time == Approx(speed / 2).epsilon(1e-8));
}

TEST_CASE("moving body: double speed is the same motion in half the time", "[figure]") {
  const MovingBody once = body_named("walk_normal");
  const MovingBody twice = body_named("walk_normal", {2, 0.5});
  for (const double time : {0.1, 0.4, 0.9, 7.3})
    CHECK((once.joint(Bone::foot_left, 2 * time) - twice.joint(Bone::foot_left, time)).norm() <
          1e-13);
}

TEST_CASE("moving body: after ten hours a walk is what it was", "[figure]") {
  const BodyMotion motion = motion_named("walk_fast");
  const MovingBody body(motion, {});
  const int n_cycles = 40000;
  const Vec3 way(n_cycles * motion.cycle_time * motion.forward_speed, 0, 0);
  const Vec3 soon = body.joint(Bone::foot_right, 2.2);
  const Vec3 late = body.joint(Bone::foot_right, 2.2 + n_cycles * motion.cycle_time);
  CHECK((late - soon - way).norm() < 1e-9);
}

TEST_CASE("moving body: a bone's frame moves as the bone", "[figure]") {
  const auto body = std::make_shared<const MovingBody>(body_named("turn"));
  Motion motion;
  motion.kind = Motion::Kind::follow;
  motion.frame = bone_frame(body, Bone::head);
  CHECK(motion.pose(2.3).rotation == body->pose(Bone::head, 2.3).rotation);
  CHECK(motion.pose(2.3).translation == body->pose(Bone::head, 2.3).translation);
  CHECK_THROWS_AS(bone_frame(nullptr, Bone::head), ContractError);
}

TEST_CASE("moving body: it is not played backward nor begun with a jump", "[figure]") {
  const BodyMotion motion = motion_named("turn");
  CHECK_THROWS_AS(MovingBody(motion, {0, 1}), ContractError);
  CHECK_THROWS_AS(MovingBody(motion, {-1, 1}), ContractError);
  CHECK_THROWS_AS(MovingBody(motion, {1, 0}), ContractError);
  CHECK_THROWS_AS(MovingBody(BodyMotion{}, {}), ContractError);
}

}  // namespace pleat
