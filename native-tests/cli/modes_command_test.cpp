#include <algorithm>
#include <catch2/catch.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/files/json_text.h"
#include "core/files/obj_file.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/bars.h"
#include "native-tests/support/small_scene.h"

namespace pleat {
namespace {

std::string obj_of(const Positions& positions, const std::vector<Triangle>& triangles) {
  const std::vector<std::optional<CornerTexture>> none(triangles.size());
  return write_obj({positions, triangles, none, {}, {}, {}});
}

/// A folder with a bar, straight and bent, and a small scene.
struct BarFolder {
  ScratchFolder folder;
  FineBox box{{1, 0.2, 0.2}, 2};
  std::string straight = (folder / "straight.obj").string();
  std::string arc = (folder / "arc.obj").string();
  std::string out = (folder / "frames").string();

  BarFolder() {
    write(straight, obj_of(box.positions, box.triangles));
    write(arc, obj_of(bent(box.positions, 1), box.triangles));
  }

  Ending run(std::vector<std::string> words) const { return pleat_command(folder, words); }
  Json json(std::vector<std::string> words) const {
    words.emplace_back("--json");
    const Ending ending = run(std::move(words));
    CAPTURE(ending.error);
    REQUIRE(ending.status == 0);
    return parse_json(ending.out);
  }
  ObjMesh frame(const std::string& name) const { return read_obj(text_of(out + "/" + name)); }
};

}  // namespace

TEST_CASE("modes command: six rigid motions, then what a bar swings like", "[cli]") {
  const BarFolder place;
  const Json json = place.json({"modes", place.straight, "--modes", "3", "--size", "0.1", "--out",
                                place.out, "--young", "4e6"});
  CHECK(json.at("n_rigid") == 6);
  REQUIRE(json.at("modes").size() == 3);
  CHECK(json.at("modes")[0].at("over_first") == 1.0);
  CHECK(json.at("modes")[0].at("residual") < 1e-8);
  const double frequency = json.at("modes")[0].at("frequency_hz");
  const Json softer = place.json({"modes", place.straight, "--modes", "3", "--size", "0.1"});
  CHECK(frequency == Approx(2 * softer.at("modes")[0].at("frequency_hz").get<double>()));
  // A file for each mode, its farthest vertex moved by a tenth of the extent.
  const double extent = box_diagonal(place.box.positions);
  CHECK(farthest(place.frame("frame_000002.obj").positions, place.box.positions) ==
        Approx(extent / 10));
}

TEST_CASE("modes command: a shell and a surface alone have no frequencies", "[cli]") {
  const BarFolder place;
  for (const std::vector<std::string>& kind :
       {std::vector<std::string>{"--volume", "shell", "--size", "0.01"}, {"--surface"}}) {
    std::vector<std::string> words{"modes", place.straight, "--modes", "3"};
    words.insert(words.end(), kind.begin(), kind.end());
    const Json json = place.json(words);
    CHECK(json.at("n_rigid") == 6);
    CHECK(!json.at("modes")[0].contains("frequency_hz"));
  }
}

TEST_CASE("modes command: a scene's cloth swings about where it has come to", "[cli]") {
  const BarFolder place;
  const std::string scene = (place.folder / "scene.json").string();
  write(scene, kSmallScene);
  const Json json = place.json({"modes", scene, "--modes", "5", "--duration", "0.2"});
  CHECK(json.at("n_rigid") == 0);
  REQUIRE(json.at("modes").size() == 5);
  double before = 0;
  for (const Json& mode : json.at("modes")) {
    CHECK(mode.contains("frequency_hz"));
    CHECK(mode.at("motion_share") >= before);
    before = mode.at("motion_share");
  }
  CHECK(before <= 1);
}

TEST_CASE("inbetween command: frames begin and end with the keys", "[cli]") {
  const BarFolder place;
  const std::vector<std::string> words{
      "inbetween", place.straight, place.arc, "--frames", "5", "--modes", "6", "--size", "0.1"};
  std::vector<std::string> to_folder = words;
  to_folder.insert(to_folder.end(), {"--out", place.out, "--check"});
  const Json json = place.json(to_folder);
  REQUIRE(json.at("frames").size() == 5);
  CHECK(json.at("frames")[0].at("is_key") == true);
  CHECK(json.at("frames")[2].at("is_key") == false);
  CHECK(json.at("frames")[2].at("unequal_halves") < 0.01);
  CHECK(json.at("frames")[2].at("linear_volume_m3") < json.at("frames")[2].at("volume_m3"));
  CHECK(farthest(place.frame("frame_000000.obj").positions, place.box.positions) < 1e-9);
  CHECK(farthest(place.frame("frame_000004.obj").positions, bent(place.box.positions, 1)) < 1e-9);
  // Nothing is written over unasked.
  const Ending again = place.run(to_folder);
  CHECK(again.status == 2);
  CHECK_THAT(again.error, Catch::Contains("--overwrite"));
  std::vector<std::string> by_step = words;
  by_step[3] = "--step";
  by_step[4] = "0.02";
  CHECK(place.json(by_step).at("frames").size() > 5);
  by_step[4] = "1e-6";
  by_step.insert(by_step.end(), {"--frames", "6", "--check"});
  const Ending short_of_it = place.run(by_step);
  CHECK(short_of_it.status == 1);
  CHECK_THAT(short_of_it.error, Catch::Contains("a vertex still moves"));
}

TEST_CASE("inbetween command: bad input leaves earlier frames where they are", "[cli]") {
  const BarFolder place;
  const std::vector<std::string> words{"inbetween", place.straight, place.arc, "--out", place.out};
  std::vector<std::string> good = words;
  good.insert(good.end(), {"--frames", "3", "--size", "0.1", "--modes", "6"});
  REQUIRE(place.run(good).status == 0);
  std::vector<std::string> bad = words;
  bad.insert(bad.end(), {"--modes", "1000", "--size", "0.3", "--overwrite"});
  CHECK(place.run(bad).status == 2);
  CHECK(place.frame("frame_000002.obj").positions.cols() == place.box.positions.cols());
}

TEST_CASE("modes and inbetween commands: bad input is one sentence", "[cli]") {
  const BarFolder place;
  const std::string open = (place.folder / "open.obj").string();
  std::vector<Triangle> most = place.box.triangles;
  most.pop_back();
  write(open, obj_of(place.box.positions, most));
  const std::string flat = (place.folder / "flat.obj").string();
  Positions pressed = place.box.positions;
  pressed.row(2).setZero();
  write(flat, obj_of(pressed, place.box.triangles));
  struct Bad {
    std::vector<std::string> words;
    const char* says;
  };
  const std::vector<Bad> all = {
      {{"modes"}, "expected an OBJ file, got nothing"},
      {{"modes", open, "--volume", "lattice"}, "closed"},
      {{"modes", place.straight, "--volume", "cube"}, "--volume: expected lattice or shell"},
      {{"modes", place.straight, place.arc}, "one word too many"},
      {{"modes", place.straight, "--size", "0.2", "--modes", "900"}, "expected 1 to"},
      {{"modes", place.straight, "--surface", "--young", "1"}, "--young: a surface alone"},
      {{"modes", "scene.json", "--size", "1"}, "--size: a scene's modes"},
      {{"inbetween", place.straight}, "two keys or more"},
      {{"inbetween", place.straight, open}, "expected a key with the"},
      {{"inbetween", place.straight, place.arc, "--frames", "1"}, "--frames"},
      {{"inbetween", place.straight, place.arc, "--step", "-1"}, "--step"},
      {{"inbetween", flat, flat}, "with an area"}};
  for (const Bad& bad : all) {
    const Ending ending = place.run(bad.words);
    CAPTURE(bad.words, ending.error);
    CHECK(ending.status == 2);
    CHECK_THAT(ending.error, Catch::Contains(bad.says));
    CHECK(std::count(ending.error.begin(), ending.error.end(), '\n') == 1);
  }
}

}  // namespace pleat
