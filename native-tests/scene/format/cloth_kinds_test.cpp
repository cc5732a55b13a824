#include "core/scene/format/scene_tables.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/run/simulation.h"
#include "core/scene/format/scene_file.h"
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

const std::array<ClothKind, 1> kKinds{{{"disc", read_disc}}};
const SceneTables kWithDisc{.cloths = kKinds};

constexpr const char* kDiscScene = R"({"cloth": {"disc": {"radius_m": 0.3}},
    "fabric": {"name": "silk"}, "refinement": {"level": 2}, "pins": [{"part": "centre"}]})";

std::string refusal(const std::string& text, const SceneTables& tables) {
  try {
    read_scene(text, fabric_library(), {}, tables);
  } catch (const InputError& error) {
    return error.where() + ": " + error.sentence();
  }
  return "";
}

}  // namespace

TEST_CASE("cloth kinds: a kind that the table has is read, written and run", "[scene]") {
  const Scene scene = read_scene(kDiscScene, fabric_library(), {}, kWithDisc);
  REQUIRE(scene.cloth.as<DiscCloth>() != nullptr);
  CHECK(scene.cloth.as<DiscCloth>()->radius == 0.3);
  const std::string written = write_scene(scene);
  CHECK(write_scene(read_scene(written, fabric_library(), {}, kWithDisc)) == written);

  Simulation simulation(scene);
  CHECK(simulation.model().n_vertices() == 81);
  CHECK(simulation.model().n_vertices() == scene.cloth->n_vertices(scene.level));
  CHECK_FALSE(simulation.model().springs.empty());
  for (int n = 0; n < 10; ++n) REQUIRE(simulation.step().ok());
  const Positions& x = simulation.state().positions;
  CHECK((x.col(4) - simulation.rest_positions().col(4)).norm() < 1e-12);
  CHECK(x(1, 0) < simulation.rest_positions()(1, 0));
}

TEST_CASE("cloth kinds: what the table lacks is refused at its place", "[scene]") {
  CHECK(refusal(kDiscScene, {}) ==
        "/cloth/disc: expected one of the keys \"sheet\", \"particles\", \"knit\", \"mesh\", "
        "\"garment\", got \"disc\"");
  CHECK(refusal(R"({"cloth": {"disc": {"radius_m": 1}}, "pins": [{"part": "rim"}]})", kWithDisc) ==
        "/pins/0/part: expected \"centre\", got \"rim\"");
}

TEST_CASE("cloth kinds: a file is refused where none can be read", "[scene]") {
  CHECK(refusal(R"({"cloth": {"mesh": {"obj": "shirt.obj"}}})", {}) ==
        "/cloth/mesh/obj: expected a mesh written out in the scene, as no files can be read here, "
        "got \"shirt.obj\"");
}

}  // namespace pleat
