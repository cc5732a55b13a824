#include "core/files/motion_file.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "core/base/check.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

using nlohmann::json;

json walk_document() { return json::parse(repository_file("assets/motions/walk_normal.json")); }

struct BadMotion {
  const char* pointer;  // place of the value that is replaced, or of the object that lacks a key
  const char* replacement;  // JSON text, or that key
  const char* where;
  const char* sentence;
};

const BadMotion kBadMotions[] = {
    {"/angles/knee_flexion_rad", "[0, 0.1, 0.2]", "/angles/knee_flexion_rad",
     "expected at least 4 keys, got an array of 3 values"},
    {"/angles/knee_flexion_rad", "[0, 0.1, 0.2, 0.1]", "/angles/knee_flexion_rad",
     "expected 50 keys, as the channels before it have, got an array of 4 values"},
    {"/angles/hip_flexion_rad/3", "35.8", "/angles/hip_flexion_rad/3",
     "expected a number between -3.141592653589793 and 3.141592653589793, got 35.8"},
    {"/angles/hip_flexion_rad/3", "null", "/angles/hip_flexion_rad/3",
     "expected a number between -3.141592653589793 and 3.141592653589793, got null"},
    {"/angles/hip_flexion_rad", "\"35\"", "/angles/hip_flexion_rad",
     "expected a number between -3.141592653589793 and 3.141592653589793, got \"35\""},
    {"/angles/hip_flexion_deg", "0", "/angles/hip_flexion_deg",
     "expected the key \"hip_flexion_rad\", got \"hip_flexion_deg\""},
    {"/pelvis_path/height_m/0", "867", "/pelvis_path/height_m/0",
     "expected a number between -10.0 and 10.0, got 867"},
    {"/cycle_time_s", "0", "/cycle_time_s", "expected a number between 0.01 and 1000.0, got 0"},
    {"/cycle_time_s", "-1", "/cycle_time_s", "expected a number between 0.01 and 1000.0, got -1"},
    {"/forward_speed_m_per_s", "1e300", "/forward_speed_m_per_s",
     "expected a number of at most 1e12 in size, got 1e+300"},
    {"/left_phase_cycles", "50", "/left_phase_cycles",
     "expected a number between 0.0 and 1.0, got 50"},
    {"/name", "7", "/name", "expected a text in quotes, got 7"},
};

void check_motion_refused(const json& document, const BadMotion& bad) {
  try {
    read_motion(document.dump());
    FAIL_CHECK("was accepted");
  } catch (const InputError& error) {
    CHECK(error.where() == bad.where);
    CHECK(error.sentence() == bad.sentence);
  }
}

}  // namespace

TEST_CASE("motion file: every shipped motion is read under its name", "[files]") {
  const std::string name = GENERATE("walk_normal", "walk_fast", "squat", "turn");
  CAPTURE(name);
  const BodyMotion motion = read_motion(repository_file("assets/motions/" + name + ".json"));
  CHECK(motion.name == name);
  CHECK(motion.keys.cols() == 50);
  CHECK_NOTHROW(motion.validate());
}

TEST_CASE("motion file: a channel is keys or a number that stays", "[files]") {
  const BodyMotion walk = read_motion(walk_document().dump());
  const auto knee = static_cast<int>(MotionChannel::knee_flexion);
  CHECK(walk.keys(knee, 0) == 0.12566);  // 7.2 degrees
  CHECK(walk.keys(knee, 1) == 0.18151);
  const auto rotation = static_cast<int>(MotionChannel::hip_rotation);
  CHECK(walk.keys.row(rotation).isZero(0));
  CHECK(walk.keys(static_cast<int>(MotionChannel::pelvis_height), 0) == 0.8335);
  CHECK(walk.cycle_time == 1.0435);
  CHECK(walk.forward_speed == 1.241);
  CHECK(walk.left_phase == 0.5);
}

TEST_CASE("motion file: bad values are refused with their place", "[files]") {
  for (const BadMotion& bad : kBadMotions) {
    CAPTURE(bad.pointer, bad.replacement);
    json document = walk_document();
    document[json::json_pointer(bad.pointer)] = json::parse(bad.replacement);
    check_motion_refused(document, bad);
  }
}

TEST_CASE("motion file: a missing joint is refused by name", "[files]") {
  const BadMotion missing = GENERATE(
      BadMotion{"/angles", "hip_flexion_rad", "/angles",
                "expected the key \"hip_flexion_rad\", got an object"},
      BadMotion{"/angles", "head_rotation_rad", "/angles",
                "expected the key \"head_rotation_rad\", got an object"},
      BadMotion{"/pelvis_path", "height_m", "/pelvis_path",
                "expected the key \"height_m\", got an object"},
      BadMotion{"", "cycle_time_s", "", "expected the key \"cycle_time_s\", got an object"});
  CAPTURE(missing.replacement);
  json document = walk_document();
  document[json::json_pointer(missing.pointer)].erase(missing.replacement);
  check_motion_refused(document, missing);
}

TEST_CASE("motion file: a motion of constants alone is a pose", "[files]") {
  json document = walk_document();
  for (auto& channel : document["angles"]) channel = 0.1;
  for (auto& channel : document["pelvis_path"]) channel = 0.2;
  const BodyMotion pose = read_motion(document.dump());
  CHECK_NOTHROW(pose.validate());
  CHECK(pose.keys.topRows(kAngleChannels).isConstant(0.1));
}

}  // namespace pleat
