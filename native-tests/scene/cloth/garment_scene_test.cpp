#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/files/plan_file.h"
#include "core/mesh/mesh_lines.h"
#include "core/run/simulation.h"
#include "core/scene/format/scene_file.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/graded_sheets.h"

namespace pleat {
namespace {

constexpr const char* kGarments[] = {"skirt", "trousers", "slim_trousers"};
constexpr const char* kMotions[] = {"walk", "fast_walk", "squat", "turn"};

std::string file_beside_garments(const std::string& name) {
  return repository_file("assets/scenes/garments/" + name);
}

Scene garment_scene(const std::string& name) {
  return read_scene(file_beside_garments(name + ".json"), fabric_library(), file_beside_garments);
}

std::string garment_refusal(const std::string& text) {
  try {
    read_scene(text, fabric_library(), file_beside_garments);
  } catch (const InputError& error) {
    return error.where() + ": " + error.sentence();
  }
  return "";
}

std::string with(const std::string& scene, const std::string& pointer, const char* value) {
  auto json = nlohmann::json::parse(file_beside_garments(scene + ".json"));
  json[nlohmann::json::json_pointer(pointer)] = nlohmann::json::parse(value);
  return json.dump();
}

}  // namespace

TEST_CASE("garment scene: what is written is read back as the same scene", "[scene]") {
  const std::string garment = GENERATE(from_range(std::begin(kGarments), std::end(kGarments)));
  const std::string motion = GENERATE(from_range(std::begin(kMotions), std::end(kMotions)));
  CAPTURE(garment, motion);
  Scene scene = garment_scene(garment + "_" + motion);
  scene.plan = patchy_plan(*base_quads(scene));
  scene.level = 0;
  const std::string text = write_scene(scene);
  CHECK(write_scene(read_scene(text, fabric_library())) == text);
}

TEST_CASE("garment scene: the waist follows the pelvis and all else is free", "[scene]") {
  const std::string garment = GENERATE(from_range(std::begin(kGarments), std::end(kGarments)));
  const Scene scene = garment_scene(garment + "_walk");
  Simulation simulation(scene);
  const Positions start = rest_cloth(scene).start;
  const MovingBody body(scene.body->motion, scene.body->playback);
  REQUIRE(!simulation.model().pins.empty());
  for (int n = 0; n < 12; ++n) REQUIRE(simulation.step().ok());
  const Pose pelvis = body.pose(Bone::pelvis, simulation.time());
  for (const Pin& pin : simulation.model().pins) {
    const Vec3 begin = start.col(pin.vertex);
    CHECK((simulation.state().positions.col(pin.vertex) - pelvis * begin).norm() < 1e-6);
  }
  CHECK(simulation.model().contact->colliders().size() == 9);  // hips, and four to a leg
}

TEST_CASE("garment scene: threads are hardly stretched where a garment begins", "[scene]") {
  const std::string garment = GENERATE(from_range(std::begin(kGarments), std::end(kGarments)));
  const int level = GENERATE(0, 1, 2);
  const RestCloth cloth = rest_cloth(garment_scene(garment + "_walk"), level);
  const ThreadEdges threads = thread_edges(*cloth.quads);
  double longest = 0;
  double shortest = 0;
  for (const ThreadEdge& edge : threads.edges) {
    const double length = (cloth.start.col(edge.to) - cloth.start.col(edge.from)).norm();
    longest = std::max(longest, length / edge.length - 1);
    shortest = std::min(shortest, length / edge.length - 1);
  }
  CAPTURE(garment, level);
  CHECK(longest < 0.01);
  // The start is of level 2. Coarser meshes have chords of its folds, which are shorter.
  if (level == 2) CHECK(shortest > -0.01);
}

TEST_CASE("garment scene: a planned mesh keeps the mass and pins no hanging vertex", "[scene]") {
  const std::string garment = GENERATE(from_range(std::begin(kGarments), std::end(kGarments)));
  Scene scene = garment_scene(garment + "_walk");
  const Simulation uniform(scene);
  scene.plan = patchy_plan(*base_quads(scene));
  const Simulation graded(scene);
  CHECK(graded.model().hanging.size() > 50);
  CHECK(graded.model().masses.sum() == Approx(uniform.model().masses.sum()).epsilon(1e-13));
  for (const Pin& pin : graded.model().pins) CHECK(graded.model().masses[pin.vertex] > 0);
}

TEST_CASE("garment scene: both ends of an edge are held off as its half asks", "[scene]") {
  const std::string garment = GENERATE(from_range(std::begin(kGarments), std::end(kGarments)));
  Scene scene = garment_scene(garment + "_walk");
  scene.plan = patchy_plan(*base_quads(scene));
  const Simulation graded(scene);
  const RestCloth cloth = rest_cloth(scene);
  const QuadMesh& quads = *cloth.quads;
  const Eigen::VectorXd& radii = graded.model().contact->options().face_radii;
  double longest = 0;
  for (const QuadFace& face : quads.faces()) {
    if (!face.active()) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      const VertexId a = face.corners[k];
      const VertexId b = face.corners[(k + 1) % 4];
      const double half =
          (quads.rest_positions().col(a) - quads.rest_positions().col(b)).norm() / 2;
      longest = std::max(longest, half);
      REQUIRE(std::min(radii[a], radii[b]) >= half * (1 - 1e-9));
    }
  }
  CHECK(radii.maxCoeff() <= 2.2 * longest);
  for (const HangingVertex& hanging : graded.model().hanging) {
    const auto at = [&](VertexId v) { return quads.rest_positions().col(v); };
    const double half = (at(hanging.parents[0]) - at(hanging.parents[1])).norm() / 2;
    for (const VertexId parent : hanging.parents) REQUIRE(radii[parent] >= 1.1 * half * (1 - 1e-9));
  }
  CHECK(radii.minCoeff() < 1.1 * longest / 3);
}

TEST_CASE("garment scene: what makes no scene is refused at its place", "[scene]") {
  CHECK(garment_refusal(with("skirt_walk", "/cloth/garment/skirt/length_m", "-0.4"))
            .find("/cloth/garment/skirt/length_m") != std::string::npos);
  CHECK(garment_refusal(with("skirt_walk", "/cloth/garment/skirt/waist_ease_m", "0.9"))
            .find("/cloth/garment/skirt/waist_ease_m") != std::string::npos);
  CHECK_FALSE(garment_refusal(with("skirt_walk", "/figure/motion", "\"absent.json\"")).empty());
  CHECK(garment_refusal(with("skirt_walk", "/pins/0/bone", "\"tail\"")).find("/pins/0/bone") == 0);
  CHECK(garment_refusal(with("skirt_walk", "/refinement", R"({"plan": {}})"))
            .find("/refinement/plan") == 0);
  auto json = nlohmann::json::parse(file_beside_garments("skirt_walk.json"));
  json.erase("figure");
  CHECK(garment_refusal(json.dump()).find("no figure") != std::string::npos);
}

TEST_CASE("garment scene: a plan for another mesh is refused", "[scene]") {
  Scene scene = garment_scene("skirt_walk");
  scene.plan = patchy_plan(*base_quads(scene));
  scene.plan->base_mesh ^= 1;
  CHECK(garment_refusal(write_scene(scene)).find("/refinement/plan") == 0);
}

TEST_CASE("garment scene: a membrane is refused on a planned mesh", "[scene]") {
  Scene scene = garment_scene("skirt_walk");
  scene.plan = patchy_plan(*base_quads(scene));
  auto json = nlohmann::json::parse(write_scene(scene));
  json["model"] = {{"elasticity", "membrane"}};
  CHECK_THAT(garment_refusal(json.dump()),
             Catch::StartsWith("/refinement/plan: expected no plan with a membrane"));
}

}  // namespace pleat
