#include "core/scene/tearing.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/scene/cloth/mesh_cloth.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/rest_cloth.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

/// A strip of cells along weft, 0.1 m each: vertex c lies above vertex n + 1 + c.
RestCloth strip(int n_cells) {
  return SheetCloth(SheetShape{0.1 * n_cells, 0.1, n_cells, 1}).at_rest(0);
}

std::optional<TornCloth> torn(const RestCloth& cloth, const Positions& positions,
                              std::span<const Pin> pins = {}) {
  Tearing tearing;
  tearing.breaking_elongation = 0.3;
  return tearing.torn(cloth, gauge_edges(cloth), positions, pins);
}

/// Moves all vertices from a column of the strip on along weft.
void pull(Positions& x, int n_cells, int from_column, double by) {
  for (int row = 0; row < 2; ++row)
    for (int c = from_column; c <= n_cells; ++c) x(0, row * (n_cells + 1) + c) += by;
}

Scene read(const std::string& cloth, const std::string& rest) {
  return read_scene("{\"cloth\": " + cloth + ", \"model\": {\"tearing\": " +
                        "{\"breaking_elongation\": 0.3}}" + rest + "}",
                    fabric_library());
}

const char* const kSheet = R"({"sheet": {"columns": 2, "rows": 2}})";

}  // namespace

TEST_CASE("tearing: nothing gives way up to the breaking elongation", "[scene]") {
  const RestCloth cloth = strip(4);
  Positions x = cloth.start;
  pull(x, 4, 2, 0.03 * (1 - 1e-9));
  CHECK_FALSE(torn(cloth, x));
  pull(x, 4, 2, 0.03 * 1e-6);
  CHECK(torn(cloth, x));
}

TEST_CASE("tearing: the end gives way whose cloth beyond is stretched more", "[scene]") {
  // It is overloaded between columns 1 and 2; on one side of these the cloth is stretched too.
  const bool is_right = GENERATE(false, true);
  const RestCloth cloth = strip(4);
  Positions x = cloth.start;
  pull(x, 4, 2, 0.04);
  pull(x, 4, is_right ? 3 : 1, 0.02);
  const auto result = torn(cloth, x);
  REQUIRE(result);
  const int column = is_right ? 2 : 1;
  REQUIRE(result->origins.size() == 2);
  CHECK(result->origins[0] + result->origins[1] == 5 + 2 * column);
  // The part with the first face keeps its vertices.
  CHECK(result->cloth.quads->faces()[0].corners == cloth.quads->faces()[0].corners);
  CHECK(result->cloth.quads->faces()[3].corners == cloth.quads->faces()[3].corners);
  CHECK(result->cloth.mesh.n_vertices() == 12);
  CHECK(result->cloth.start.cols() == 12);
  CHECK(result->cloth.start_velocities.cols() == 12);
  CHECK(result->cloth.rest_coordinates.cols() == 12);
}

TEST_CASE("tearing: where the end that is stretched more is held the other one gives way",
          "[scene]") {
  const RestCloth cloth = strip(4);
  Positions x = cloth.start;
  pull(x, 4, 2, 0.04);
  pull(x, 4, 3, 0.02);
  // One is enough: its cut would part the other.
  const auto result = torn(cloth, x, std::array{Pin{VertexId(7), {}, {}}});
  REQUIRE(result);
  CHECK(result->origins[0] + result->origins[1] == 5 + 2 * 1);
  CHECK_FALSE(torn(cloth, x, std::array{Pin{VertexId(7), {}, {}}, Pin{VertexId(1), {}, {}}}));
}

TEST_CASE("tearing: what is overloaded together gives way at one place, the worst", "[scene]") {
  const RestCloth cloth = SheetCloth(SheetShape{1, 1, 10, 10}).at_rest(0);
  Positions x = cloth.start;
  x.row(0) *= 1.4;
  for (int v = 0; v < x.cols(); ++v)
    if (v % 11 > 6) x(0, v) += 1e-3;
  const auto one = torn(cloth, x);
  REQUIRE(one);
  REQUIRE(one->origins.size() == 1);
  CHECK((one->origins[0] % 11 == 6 || one->origins[0] % 11 == 7));
  // Two places that have no face in common.
  x = cloth.start;
  for (int v = 0; v < x.cols(); ++v) {
    if (v % 11 > 1) x(0, v) += 0.04;
    if (v % 11 > 8) x(0, v) += 0.04;
  }
  const auto two = torn(cloth, x);
  REQUIRE(two);
  CHECK(two->origins.size() == 2);
}

TEST_CASE("tearing: triangles give way too, and keep their pattern and their threads", "[scene]") {
  MeshCloth mesh;
  mesh.mesh = triangulated_sheet(Triangulation::equilateral, 4, 4, 0.1);
  std::vector<CornerTexture> pattern;
  for (std::size_t f = 0; f < mesh.mesh.triangles.size(); ++f)
    pattern.push_back(flat_corners(mesh.mesh, FaceId(static_cast<std::int64_t>(f))));
  mesh.mesh.pattern = pattern;
  const RestCloth cloth = mesh.at_rest(0);
  Positions x = cloth.start;
  x.row(0) *= 1.4;
  const auto result = torn(cloth, x);
  REQUIRE(result);
  const TriangleMesh& whole = cloth.mesh;
  const TriangleMesh& cut = result->cloth.mesh;
  CHECK(cut.pattern == whole.pattern);
  CHECK(cut.warp_directions == whole.warp_directions);
  CHECK(cut.n_vertices() > whole.n_vertices());
  for (std::size_t f = 0; f < whole.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(cut.rest_positions.col(cut.triangles[f][k]) ==
            whole.rest_positions.col(whole.triangles[f][k]));
  CHECK(vertex_areas(cut).sum() == Approx(vertex_areas(whole).sum()).epsilon(1e-12));
}

TEST_CASE("tearing: its number is written back", "[scene]") {
  const Scene scene = read(kSheet, "");
  REQUIRE(scene.model.tearing);
  CHECK(scene.model.tearing->breaking_elongation == 0.3);
  const std::string text = write_scene(scene);
  CHECK(write_scene(read_scene(text, fabric_library())) == text);
  CHECK_FALSE(read_scene(R"({"cloth": {"sheet": {}}})", fabric_library()).model.tearing);
}

TEST_CASE("tearing: what cannot tear says so in one sentence", "[scene]") {
  const auto refusal = [](const std::string& cloth, const std::string& rest) -> std::string {
    try {
      read(cloth, rest);
    } catch (const InputError& error) {
      return error.where() + ": " + error.sentence();
    }
    return "";
  };
  const char* const kPair =
      R"({"particles": {"positions_m": [[0, 0, 0], [1, 0, 0]], "masses_kg": [1, 1]}})";
  CHECK_THAT(refusal(kPair, ""), Catch::Contains("particles have no faces"));
  CHECK_THAT(refusal(kSheet, R"(, "method": {"stepper": "implicit", "first_contact_m": 1e-6})"),
             Catch::Contains("/model/tearing") && Catch::Contains("first contact"));
  CHECK_THAT(refusal(kSheet, R"(, "record": {"format": "binary"})"),
             Catch::Contains("/model/tearing") && Catch::Contains("frames"));
  CHECK_THROWS_AS(expect_whole(read(kSheet, "")), InputError);
}

}  // namespace pleat
