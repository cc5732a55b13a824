#include "core/scene/deform/posing_section.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/files/motion_file.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

using Moment = Posing::Moment;

constexpr double kTime = 1.7;  // [s], beyond the blend

BodyMotion shipped_motion(const std::string& name) {
  return read_motion(repository_file("assets/motions/" + name + ".json"));
}

Moment arms_out() { return {shipped_motion("arms_out"), 1}; }

/// Standing, with one angle of the right side's arm changed [rad].
Moment with_angle(MotionChannel channel, double angle) {
  Moment moment = arms_out();
  moment.motion.keys.row(static_cast<int>(MotionChannel::shoulder_abduction)).setZero();
  moment.motion.keys.row(static_cast<int>(channel)).setConstant(angle);
  return moment;
}

/// A joint of a body that looks along z, in the cloth's axes [m].
Vec3 joint(const Moment& moment, Bone bone) {
  const Vec3 x = MovingBody(moment.motion, {}).joint(bone, moment.time);
  return {-x.z(), x.y(), x.x()};
}

std::string refusal(const std::string& text) {
  const Json json = parse_json(text);
  const FileSource files = [](const std::string& name) {
    return repository_file("assets/motions/" + name);
  };
  try {
    read_posing(JsonReader(json), files);
  } catch (const InputError& error) {
    return error.where() + ": " + error.sentence();
  }
  return "";
}

std::string posing_text(const std::string& motion, const std::string& bone,
                        const std::string& facing) {
  return R"({"at_rest": {"motion": "arms_out.json", "time_s": 1},
             "posed": {"motion": ")" +
         motion + R"(", "time_s": 2}, "pinned_bone": ")" + bone + R"(", "facing": )" + facing + "}";
}

}  // namespace

TEST_CASE("posing: the posture in which the cloth rests moves nothing", "[scene]") {
  const Posing posing(arms_out(), {shipped_motion("arms_out"), 2.5}, Bone::pelvis,
                      Vec3(0.6, 0, 0.8));
  for (int b = 0; b < kBones; ++b) {
    const Pose pose = posing.of(static_cast<Bone>(b));
    CHECK((pose.rotation - Mat3::Identity()).norm() < 1e-12);
    CHECK(pose.translation.norm() < 1e-12);
  }
}

TEST_CASE("posing: the pinned bone stays, and bones stay joined", "[scene]") {
  const std::string name = GENERATE("walk_normal", "squat", "turn");
  CAPTURE(name);
  const Posing posing(arms_out(), {shipped_motion(name), kTime}, Bone::thorax, Vec3::UnitZ());
  const Pose pinned = posing.of(Bone::thorax);
  CHECK((pinned.rotation - Mat3::Identity()).norm() < 1e-12);
  CHECK(pinned.translation.norm() < 1e-12);
  const std::pair<Bone, Bone> joined[] = {{Bone::thorax, Bone::upper_arm_left},
                                          {Bone::upper_arm_left, Bone::forearm_left},
                                          {Bone::thorax, Bone::upper_arm_right},
                                          {Bone::pelvis, Bone::thorax}};
  for (const auto& [above, below] : joined) {
    CAPTURE(bone_name(below));
    const Vec3 at_rest = joint(arms_out(), below);
    CHECK((posing.of(above) * at_rest - posing.of(below) * at_rest).norm() < 1e-12);
  }
}

TEST_CASE("posing: a raised arm points where its angle says", "[scene]") {
  const double angle = 0.9;
  const bool is_forward = GENERATE(true, false);
  const auto channel =
      is_forward ? MotionChannel::shoulder_flexion : MotionChannel::shoulder_abduction;
  const Posing posing(with_angle(channel, 0), with_angle(channel, angle), Bone::thorax,
                      Vec3::UnitZ());
  const Vec3 down(0, -1, 0);
  const Vec3 outward = is_forward ? Vec3(0, 0, 1) : Vec3(1, 0, 0);  // the left is at x > 0
  const Vec3 arm = posing.of(Bone::upper_arm_left).rotation * down;
  CHECK((arm - (std::cos(angle) * down + std::sin(angle) * outward)).norm() < 1e-12);
}

TEST_CASE("posing: what is no figure is refused at its place", "[scene]") {
  CHECK(refusal(posing_text("turn.json", "thorax", "[0, 0, 2]")).empty());
  CHECK(refusal(posing_text("turn.json", "thorax", "[0, 1, 2]"))
            .find("/facing: expected a level direction, whose y is 0") == 0);
  CHECK(refusal(posing_text("turn.json", "tail", "[0, 0, 1]")).find("/pinned_bone: expected one") ==
        0);
  CHECK(refusal(R"({"at_rest": {"motion": "turn.json"}})")
            .find("/at_rest: expected the key "
                  "\"time_s\"") == 0);
}

}  // namespace pleat
