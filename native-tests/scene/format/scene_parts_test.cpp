#include "core/scene/format/scene_parts.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/run/simulation.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/tearing.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

/// A kind of cloth that the program does not have: a square in a circle.
class DiscCloth final : public QuadCloth {
 public:
  explicit DiscCloth(double its_radius) : radius(its_radius) {}

  double radius;  // [m]

  const char* key() const override { return "disc"; }
  Json json() const override { return {{"radius_m", radius}}; }
  double rest_diagonal() const override { return 2 * radius; }
  QuadMesh base_quads() const override {
    SheetShape square;
    square.width = square.height = std::sqrt(2.0) * radius;
    square.columns = square.rows = 2;
    return QuadMesh::sheet(square);
  }
  using QuadCloth::at_rest;
  RestCloth at_rest(QuadMesh quads) const override {
    RestCloth cloth = flat_rest_cloth(std::move(quads));
    cloth.groups = {{"centre", {VertexId(4)}}};
    return cloth;
  }
  std::string read_part(const JsonReader& reader) const override {
    if (reader.text() != "centre") reader.fail("\"centre\"");
    return "centre";
  }
  std::vector<VertexId> base_part(const std::string&) const override { return {VertexId(4)}; }
};

SceneCloth read_disc(const JsonReader& reader, const ClothSurroundings&) {
  reader.allow_keys({"radius_m"});
  return DiscCloth(reader.at("radius_m").number(kPositive));
}

SceneParts parts_with_disc() {
  SceneParts parts = plain_scene_parts();
  parts.cloths.push_back({"disc", read_disc});
  return parts;
}

constexpr const char* kDiscScene = R"({"cloth": {"disc": {"radius_m": 0.3}},
    "fabric": {"name": "silk"}, "refinement": {"level": 2}, "pins": [{"part": "centre"}]})";

std::string refusal(const std::string& text, const SceneParts& parts) {
  try {
    read_scene(text, fabric_library(), {}, parts);
  } catch (const InputError& error) {
    return error.where() + ": " + error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("scene parts: a kind of cloth that is registered is read, written and run", "[scene]") {
  const Scene scene = read_scene(kDiscScene, fabric_library(), {}, parts_with_disc());
  REQUIRE(scene.cloth.as<DiscCloth>() != nullptr);
  CHECK(scene.cloth.as<DiscCloth>()->radius == 0.3);
  const std::string written = write_scene(scene);
  CHECK(write_scene(read_scene(written, fabric_library(), {}, parts_with_disc())) == written);

  Simulation simulation(scene);
  CHECK(simulation.model().n_vertices() == 81);
  CHECK(simulation.model().n_vertices() == scene.cloth->n_vertices(scene.level));
  CHECK_FALSE(simulation.model().springs.empty());
  for (int n = 0; n < 10; ++n) REQUIRE(simulation.step().ok());
  const Positions& x = simulation.state().positions;
  CHECK((x.col(4) - simulation.rest_positions().col(4)).norm() < 1e-12);
  CHECK(x(1, 0) < simulation.rest_positions()(1, 0));
}

TEST_CASE("scene parts: what is not registered is refused at its place", "[scene]") {
  const std::string refused_end = ", as this view shows none; pleat run takes it";
  const SceneParts plain = plain_scene_parts();
  CHECK(refusal(R"({"cloth": {"garment": {"skirt": {}}}})", plain) ==
        "/cloth/garment: expected no garment" + refused_end);
  CHECK(refusal(R"({"figure": {}, "cloth": {"sheet": {}}})", plain) ==
        "/figure: expected no figure" + refused_end);
  CHECK(refusal(R"({"cloth": {"sheet": {}}, "refinement": {"plan": {}}})", plain) ==
        "/refinement/plan: expected no plan" + refused_end);
  CHECK(refusal(R"({"cloth": {"mesh": {"obj": "shirt.obj"}}})", plain) ==
        "/cloth/mesh/obj: expected a mesh written out in the scene, as no files can be read here, "
        "got \"shirt.obj\"");
  CHECK(refusal(kDiscScene, plain) ==
        "/cloth/disc: expected one of the keys \"sheet\", \"particles\", \"knit\", \"mesh\", "
        "\"garment\", got \"disc\"");
  CHECK(refusal(R"({"cloth": {"disc": {"radius_m": 1}}, "pins": [{"part": "rim"}]})",
                parts_with_disc()) == "/pins/0/part: expected \"centre\", got \"rim\"");
}

TEST_CASE("scene parts: plain parts and tearing read the scenes without figures and garments",
          "[scene]") {
  SceneParts parts = plain_scene_parts();
  parts.read_tearing = read_tearing;
  for (const char* name : kSceneFiles) {
    CAPTURE(name);
    CHECK(write_scene(read_scene(scene_text(name), fabric_library(), {}, parts)) ==
          write_scene(read_scene(scene_text(name), fabric_library())));
  }
}

}  // namespace pleat
