#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/files/json_text.h"
#include "core/files/obj_file.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/meshes.h"
#include "native-tests/support/small_scene.h"

namespace pleat {
namespace {

/// A folder with a flat sheet of 21 x 21 vertices and a small scene.
struct SheetFolder {
  ScratchFolder folder;
  std::string sheet = (folder / "sheet.obj").string();
  std::string out = (folder / "levels").string();

  SheetFolder() {
    const TriangleMesh mesh = triangulated_sheet(Triangulation::alternating, 20, 20, 0.05);
    write(sheet, text_of_mesh(mesh.rest_positions, mesh.triangles));
  }

  static std::string text_of_mesh(const Positions& positions,
                                  const std::vector<Triangle>& triangles) {
    return write_obj({positions,
                      triangles,
                      std::vector<std::optional<CornerTexture>>(triangles.size()),
                      {},
                      {},
                      {}});
  }

  Ending run(const std::vector<std::string>& words) const { return pleat_command(folder, words); }
};

}  // namespace

TEST_CASE("hierarchy command: levels halve, are written and told of", "[cli]") {
  const SheetFolder place;
  const Ending ending = place.run({"hierarchy", place.sheet, "--out", place.out, "--json"});
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  const Json told = parse_json(ending.out);
  CHECK(told.at("processor_ms") > 0);
  const Json& levels = told.at("levels");
  REQUIRE(levels.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) {
    const ObjMesh mesh = read_obj(text_of(place.out + "/frame_00000" + std::to_string(k) + ".obj"));
    CHECK(mesh.positions.cols() == levels[k].at("n_vertices"));
    CHECK(mesh.triangles.size() == levels[k].at("n_triangles"));
    // Chords of a flat sheet are the surface.
    CHECK(levels[k].at("chord_gap") == Approx(0).margin(1e-12));
  }
  CHECK(levels[0].at("n_vertices") == 441);
  CHECK(levels[1].at("n_vertices") == 221);
  CHECK(levels[0].at("mean_edge_m") < levels[1].at("mean_edge_m"));
}

TEST_CASE("hierarchy command: deeper than the mesh allows ends at the last level, and says so",
          "[cli]") {
  const SheetFolder place;
  const Ending ending = place.run({"hierarchy", place.sheet, "--levels", "12", "--json"});
  REQUIRE(ending.status == 0);
  const Json json = parse_json(ending.out);
  CHECK(json.at("levels").size() < 13);
  CHECK(json.at("levels").back().at("n_vertices") >= 4);
  CHECK(json.at("shortage").get<std::string>().find("expected 12") != std::string::npos);
}

TEST_CASE("hierarchy command: without a guard the table tells what goes wrong", "[cli]") {
  const SheetFolder place;
  const auto coarsest = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all{"hierarchy", place.sheet, "--json"};
    all.insert(all.end(), words.begin(), words.end());
    const Ending ending = place.run(all);
    CAPTURE(ending.error);
    REQUIRE(ending.status == 0);
    return parse_json(ending.out).at("levels").back();
  };
  const Json right = coarsest({});
  for (const char* const key : {"turned_triangles", "strayed_borders", "crowded_edges"})
    CHECK(right.at(key) == 0);
  CHECK(right.at("covered_share") == Approx(1));
  const Json wrong = coarsest({"--without", "borders,links"});
  CHECK(wrong.at("n_vertices") == right.at("n_vertices"));
  CHECK(wrong.at("strayed_borders") > 0);
  CHECK(wrong.at("covered_share") < 0.97);
}

TEST_CASE("hierarchy command: bad input is one sentence, and nothing is written", "[cli]") {
  const SheetFolder place;
  const auto fails = [&](std::vector<std::string> words, const std::string& sentence) {
    words.insert(words.end(), {"--out", place.out});
    const Ending ending = place.run(words);
    CAPTURE(sentence, ending.error);
    CHECK(ending.status != 0);
    CHECK(ending.error.find(sentence) != std::string::npos);
    CHECK(std::count(ending.error.begin(), ending.error.end(), '\n') == 1);
    CHECK_FALSE(std::filesystem::exists(place.out + "/frame_000000.obj"));
  };
  for (const std::string ratio : {"0.1", "0.9", "2"})
    fails({"hierarchy", place.sheet, "--ratio", ratio}, "--ratio");
  fails({"hierarchy", place.sheet, "--ratio", "half"}, "--ratio");
  fails({"hierarchy", place.sheet, "--weights", "none"}, "expected inverse_distance");
  fails({"hierarchy", place.sheet, "--levels", "0"}, "--levels");
  for (const std::string names : {"corners", "flips,", "flips,flip", ""})
    fails({"hierarchy", place.sheet, "--without", names}, "--without");
  fails({"hierarchy", (place.folder / "none.obj").string()}, "none.obj");

  // Three triangles at an edge, and two that are wound against each other.
  const std::string open = (place.folder / "bad.obj").string();
  write(open, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
  fails({"hierarchy", open}, "bad.obj");
  write(open, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nf 1 2 3\nf 1 2 4\n");
  fails({"hierarchy", open}, "bad.obj");
}

}  // namespace pleat
