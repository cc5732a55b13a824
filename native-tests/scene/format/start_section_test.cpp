#include "core/scene/format/start_section.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/files/frame_file.h"
#include "core/run/simulation.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/rest_cloth.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

/// A sheet of 3 x 2 vertices, 6, 15 and 45 after refinements, above a floor.
std::string scene_with_start(const std::string& start, int level) {
  return R"({"cloth": {"sheet": {"columns": 2, "rows": 1, "width_m": 0.2, "height_m": 0.1,
                                 "origin_m": [0, 1, 0]}},
             "refinement": {"level": )" +
         std::to_string(level) +
         R"(}, "world": {"colliders": [{"plane": {"point_m": [0, 0, 0], "normal": [0, 1, 0]}}]},
             "start": )" +
         start + "}";
}

Scene read(const std::string& start, int level, const std::string& file = "") {
  return read_scene(scene_with_start(start, level), fabric_library(),
                    [&](const std::string&) { return file; });
}

/// Places that are another function of the rest positions in each coordinate, linear; velocities
/// alike.
StartState state_at(const RestCloth& cloth) {
  StartState start;
  const Positions& rest = cloth.mesh.rest_positions;
  start.positions = rest.colwise() + Vec3(0.25, 0.5, -0.75);
  start.positions.row(1) += 0.5 * rest.row(0);
  start.velocities = (2 * rest).colwise() + Vec3(1, 0, 0);
  return start;
}

std::string refusal(const std::string& start, int level = 0, const std::string& file = "") {
  try {
    Simulation simulation(read(start, level, file));
  } catch (const InputError& error) {
    return error.where() + ": " + error.sentence();
  }
  return "";
}

std::string written(const StartState& start) { return json_start(start).dump(); }

}  // namespace

TEST_CASE("start: cloth of any refinement begins on a start of any other", "[scene]") {
  const int of_start = GENERATE(0, 1, 2);
  const int level = GENERATE(0, 1, 2);
  CAPTURE(of_start, level);
  const Scene plain = read_scene(
      R"({"cloth": {"sheet": {"columns": 2, "rows": 1, "width_m": 0.2, "height_m": 0.1,
                              "origin_m": [0, 1, 0]}}})",
      fabric_library(), {});
  const StartState start = state_at(rest_cloth(plain, of_start));
  const StartState expected = state_at(rest_cloth(plain, level));
  // Written out, in a file, and with all defaults written out.
  const Scene scene = read(written(start), level);
  const Scene again =
      read_scene(write_scene(read("\"state.json\"", level, written(start))), fabric_library(), {});
  for (const Scene* one : {&scene, &again}) {
    CHECK(one->start->level == of_start);
    const RestCloth cloth = rest_cloth(*one);
    REQUIRE(cloth.start.cols() == expected.positions.cols());
    CHECK((cloth.start - expected.positions).cwiseAbs().maxCoeff() < 1e-15);
    CHECK((cloth.start_velocities - expected.velocities).cwiseAbs().maxCoeff() < 1e-15);
    // Springs keep the lengths that they have at rest.
    CHECK(cloth.mesh.rest_positions == rest_cloth(plain, level).mesh.rest_positions);
    const Simulation simulation(*one);
    CHECK(simulation.state().velocities == cloth.start_velocities);
  }
}

TEST_CASE("start: a frame in OBJ begins at rest", "[scene]") {
  const Scene plain =
      read(R"({"positions_m": [[0,1,0],[0,1,1],[0,2,0],[0,2,1],[0,3,0],[0,3,1]]})", 0);
  const RestCloth cloth = rest_cloth(plain);
  const Positions places = cloth.mesh.rest_positions.colwise() + Vec3(0, 0.5, 0);
  const std::string obj = obj_text({{}, cloth.mesh.triangles}, places);
  const RestCloth begun = rest_cloth(read("\"frame.obj\"", 0, obj));
  CHECK(begun.start == places);
  CHECK(begun.start_velocities.isZero(0));
}

TEST_CASE("start: one that this cloth cannot begin at is refused with a sentence", "[scene]") {
  const std::string six = "[[0,1,0],[0,1,1],[0,2,0],[0,2,1],[0,3,0],[0,3,1]]";
  CHECK(refusal(R"({"positions_m": [[0,1,0],[0,1,1]]})") ==
        "/start: expected a start of this cloth, which has 6 vertices at level 0, got 2");
  CHECK(refusal(R"({"positions_m": )" + six + R"(, "velocities_m_per_s": [[0,0,0]]})") ==
        "/start: expected as many velocities as positions, 6, got 1");
  CHECK(refusal(R"({"positions_m": [[0,1,0],[0,1,1],[0,2,null],[0,2,1],[0,3,0],[0,3,1]]})")
            .find("/start/positions_m/2") == 0);
  CHECK(refusal(R"({"positions_m": [[0,1,0],[0,1,1],[0,-0.03,0],[0,2,1],[0,3,0],[0,3,1]]})") ==
        "/start: expected cloth outside of solids, got vertex 2 30 mm inside of one");
  CHECK(refusal("\"f.obj\"", 0, "v 0 1 0\nv 1 1 0\nv 0 2 0\nf 1 2 3\n") ==
        "f.obj: expected a start of this cloth, which has 6 vertices at level 0, got 3");
  CHECK(refusal("\"f.obj\"", 0, "v 0 1 nan\nv 1 1 0\nv 0 2 0\nf 1 2 3\n").find("f.obj: line 1") ==
        0);
  const std::string others =
      "v 0 1 0\nv 0 1 1\nv 0 2 0\nv 0 2 1\nv 0 3 0\nv 0 3 1\nf 1 2 4\nf 1 4 3\nf 3 4 6\nf 2 1 5\n";
  CHECK(
      refusal("\"f.obj\"", 0, others) ==
      "f.obj: line 8: expected a face of this cloth, got one of vertices that have none together");
  CHECK(refusal("\"f.json\"", 0, R"({"places": []})").find("f.json: ") == 0);
  CHECK(refusal("7").find("/start: expected") == 0);
}

}  // namespace pleat
