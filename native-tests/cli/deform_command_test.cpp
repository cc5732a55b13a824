#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "core/files/json_text.h"
#include "core/files/obj_file.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/small_scene.h"

namespace pleat {
namespace {

constexpr const char* kDeformScene = R"({
  "name": "small sheet",
  "cloth": {"sheet": {"width_m": 0.4, "height_m": 0.4, "vertices": [9, 9],
                      "triangulation": "alternating"}},
  "fabric": "ramie",
  "pins": [{"group": "left_edge"}],
  "handles": [{"name": "hand", "group": "lower_right", "move_m": [0, 0.1, 0]}]
})";

/// A folder with a scene and a mesh in it.
struct Workplace {
  ScratchFolder folder;
  std::string scene = (folder / "scene.json").string();
  std::string mesh = (folder / "any.obj").string();
  std::string out = (folder / "out.obj").string();

  Workplace() {
    write(scene, kDeformScene);
    write(mesh,
          "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 1 0 1\no left end\nf 1 3 2\no\ng side\nf 2 3 4\n"
          "g corner\np 4\n");
  }

  Ending deform(const std::string& file, std::vector<std::string> words) const {
    words.insert(words.begin(), {"deform", file});
    return pleat_command(folder, words);
  }
  Json json(const std::string& file, std::vector<std::string> words) const {
    words.emplace_back("--json");
    const Ending ending = deform(file, std::move(words));
    CAPTURE(ending.error);
    REQUIRE(ending.status == 0);
    return parse_json(ending.out);
  }
  ObjMesh result() const { return read_obj(text_of(out)); }
};

}  // namespace

TEST_CASE("deform command: energy falls from step to step and is told with its terms", "[cli]") {
  const Workplace place;
  const Json json = place.json(place.scene, {});
  CHECK(json.at("scene") == "small sheet");
  CHECK(json.at("fabric") == "ramie");
  CHECK(json.at("form") == "consistent");
  CHECK(json.at("n_vertices") == 81);
  CHECK(json.at("n_triangles") == 128);
  CHECK(json.at("n_edges") == 208);
  CHECK(json.at("n_held") == 10);
  CHECK(json.at("status") == "ok");
  double last = json.at("begin").at("energy").get<double>();
  REQUIRE_FALSE(json.at("steps").empty());
  for (const Json& step : json.at("steps")) {
    const auto energy = step.at("energy").get<double>();
    CHECK(energy <= last);
    last = energy;
    double sum = 0;
    for (const char* term : {"recovery", "stretch", "bending"})
      sum += json.at("weights").at(term).get<double>() * step.at("terms").at(term).get<double>();
    CHECK(sum == Approx(energy));
  }
  CHECK(json.at("farthest_m").get<double>() >= 0.1);
}

TEST_CASE("deform command: the shape goes out with faces, texture and groups", "[cli]") {
  const Workplace place;
  const Ending ending = place.deform(place.scene, {"--out", place.out});
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  CHECK(ending.out.find("status ok") != std::string::npos);
  const ObjMesh shape = place.result();
  REQUIRE(shape.positions.cols() == 81);
  CHECK(shape.positions.col(80).isApprox(Vec3(0.2, 0.1, 0.2)));
  CHECK(shape.positions.col(9).isApprox(Vec3(-0.2, 0, -0.15)));
  CHECK(shape.positions(1, 79) > 0);
  CHECK(shape.textures.at(0).has_value());
  CHECK(shape.groups.size() == 8);
  // Its own result is an input like any other.
  REQUIRE(place.deform(place.out, {"--fabric", "silk", "--pin", "left_edge"}).status == 0);
}

TEST_CASE("deform command: a mesh is pinned and pulled by number, name, box and place", "[cli]") {
  const Workplace place;
  const std::vector<std::vector<std::string>> same = {
      {"--pin", "0", "--pin", "1,2", "--handle", "3:0,0.5,0"},
      {"--pin", "left end", "--handle", "corner:0,0.5,0"},
      {"--pin", "box:0,0,0,0,0,1", "--pin", "near:0.9,0,0.1", "--handle",
       "box:0.5,0,0.5,1,0,1:0,0.5,0"},
      {"--pin", "near:0,0,0,1", "--handle", "near:1,0,1:0,5e-1,0"},
  };
  for (std::vector<std::string> words : same) {
    CAPTURE(words);
    words.insert(words.end(), {"--fabric", "wool", "--out", place.out, "--overwrite"});
    const Json json = place.json(place.mesh, words);
    CHECK(json.at("scene") == "any");
    CHECK(json.at("n_held") == 4);
    const Positions x = place.result().positions;
    CHECK(x.col(3).isApprox(Vec3(1, 0.5, 1)));
    CHECK(x.leftCols(3).isApprox((Positions(3, 3) << 0, 1, 0, 0, 0, 0, 0, 0, 1).finished()));
  }
}

TEST_CASE("deform command: of stretch alone it is told that it holds no one shape", "[cli]") {
  const Workplace place;
  const std::string sentence = "stretch alone resists no bending";
  const auto told = [&](std::vector<std::string> words) {
    return place.deform(place.scene, std::move(words)).out.find(sentence) != std::string::npos;
  };
  CHECK(told({"--terms", "stretch"}));
  CHECK(told({"--weights", "0,1,0", "--json"}));
  CHECK_FALSE(told({"--terms", "stretch,bending"}));
  CHECK_FALSE(told({"--terms", "recovery,stretch", "--json"}));
}

TEST_CASE("deform command: options take the place of the scene's fabric, form, terms and handles",
          "[cli]") {
  const Workplace place;
  CHECK(place.json(place.scene, {"--fabric", "silk"}).at("fabric") == "silk");
  const Json own = place.json(place.scene, {"--weights", "1,2,0.5"});
  CHECK(own.at("fabric") == "own weights");
  CHECK(own.at("weights") == Json({{"recovery", 1.0}, {"stretch", 2.0}, {"bending", 0.5}}));
  const Json measured = place.json(place.scene, {"--measure", "0.98,1.05,2"});
  CHECK(measured.at("fit").at("clamped") == Json({"bending"}));
  CHECK(measured.at("fit").at("leave_one_out_error").at("stretch").get<double>() > 0);
  CHECK(measured.at("fit").at("nearest_fabric").is_string());
  CHECK(place.deform(place.scene, {"--measure", "0.98,1.05,2"}).out.find("bending lies outside") !=
        std::string::npos);
  CHECK(place.json(place.scene, {"--form", "published"}).at("form") == "published");
  CHECK(place.json(place.scene, {"--terms", "recovery,stretch"}).at("weights").at("bending") == 0);
  REQUIRE(place
              .deform(place.scene,
                      {"--handle", "hand:0,0.2,0", "--pin", "near:0.2,0,-0.2", "--out", place.out})
              .status == 0);
  CHECK(place.result().positions.col(80).isApprox(Vec3(0.2, 0.2, 0.2)));
  CHECK(place.result().positions.col(8).isApprox(Vec3(0.2, 0, -0.2)));
}

TEST_CASE("deform command: bad input is one sentence that names its source, and exit status 2",
          "[cli]") {
  const Workplace place;
  write(place.folder / "bad.json", "{\"cloth\": {}, \"fabric\": \"linen\"}");
  write(place.folder / "bad.obj", "v 0 0 0\nf 1 2 3\n");
  struct Bad {
    std::string file;
    std::vector<std::string> words;
    std::string sentence;
  };
  const std::string bad_obj = (place.folder / "bad.obj").string();
  const std::vector<Bad> cases = {
      {place.mesh, {}, "--fabric: expected this, --measure or --weights beside a mesh, got none"},
      {place.scene, {"--fabric", "lace"}, "--fabric: expected one of fine cotton, "},
      {place.scene,
       {"--fabric", "silk", "--weights", "1,1,1"},
       "--weights: expected either this or --fabric, got both"},
      {place.scene, {"--weights", "1,1"}, "--weights: expected 3 numbers separated by commas"},
      {place.scene, {"--weights", "1,x,1"}, "--weights: expected a number >= 0.0, got \"x\""},
      {place.scene, {"--weights", "0,0,0"}, "--weights: expected a weight > 0, got three zeros"},
      {place.scene, {"--measure", "1,0,1"}, "--measure: expected a number > 0.0, got 0"},
      {place.scene, {"--form", "sharp"}, "--form: expected one of \"consistent\", \"published\""},
      {place.scene, {"--terms", "shear"}, "--terms: expected one of \"recovery\""},
      {place.scene, {"--pin", "81"}, "--pin: expected a whole number from 0 to 80, got 81"},
      {place.scene, {"--pin", "middle"}, "--pin: expected one of the groups "},
      {place.scene, {"--pin", "box:1,2"}, "--pin: expected 6 numbers separated by commas"},
      {place.scene, {"--pin", "near:1,2"}, "--pin: expected 3 or 4 numbers separated by commas"},
      {place.scene,
       {"--pin", "80"},
       "scene.json: /handles/0: expected one place for each vertex, "},
      {place.scene, {"--handle", "3"}, "--handle: expected a place and how far it goes"},
      {place.scene, {"--handle", "3:1,2"}, "--handle: expected 3 numbers separated by commas"},
      {place.scene,
       {"--handle", "0:0,1,0"},
       "--handle: expected one place for each vertex, got handle \"0\" with vertex 0, which is "
       "pinned where it rests"},
      {place.scene,
       {"--handle", "hand:0,1,0", "--handle", "hand:0,2,0"},
       "--handle: expected each handle once, got \"hand\" twice"},
      {place.mesh,
       {"--weights", "0,1,1"},
       "any.obj: /pins: expected pins and handles that leave one shape of least energy"},
      {place.mesh,
       {"--weights", "0,1,1", "--pin", "0,1"},
       "any.obj: /pins: expected pins and handles that leave one shape of least energy"},
      {(place.folder / "bad.json").string(), {}, "bad.json: /cloth: expected one of the keys"},
      {bad_obj, {"--fabric", "silk"}, bad_obj + ": line 2: expected the number of a vertex"},
      {(place.folder / "none.json").string(), {}, "none.json: "},
      {place.scene, {"--level", "1"}, "--level: unknown option"},
      {place.scene, {"--out", (place.folder / "no" / "out.obj").string()}, "out.obj: "},
  };
  for (const Bad& bad : cases) {
    const Ending ending = place.deform(bad.file, bad.words);
    CAPTURE(bad.sentence, ending.error, ending.out);
    CHECK(ending.status == 2);
    CHECK(ending.error.find(bad.sentence) != std::string::npos);
    CHECK(ending.error.rfind("pleat: ", 0) == 0);
    CHECK(n_lines(ending.error) == 1);
    CHECK(ending.out.empty());
  }
  CHECK_FALSE(std::filesystem::exists(place.out));
}

TEST_CASE("deform command: the shipped T-shirt takes its pose and keeps its seams", "[cli]") {
  const Workplace place;
  const Ending ending =
      place.deform(repository_path("assets/deform/t_shirt.json"), {"--out", place.out});
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  const ObjMesh rest = read_obj(repository_file("assets/meshes/t_shirt.obj"));
  const ObjMesh posed = place.result();
  CHECK(posed.triangles == rest.triangles);
  CHECK(posed.textures == rest.textures);
  REQUIRE(posed.groups.size() == rest.groups.size());
  for (std::size_t k = 0; k < rest.groups.size(); ++k) {
    CHECK(posed.groups[k].name == rest.groups[k].name);
    CHECK(posed.groups[k].vertices == rest.groups[k].vertices);
  }
  CHECK((posed.positions - rest.positions).colwise().norm().maxCoeff() > 0.1);
}

TEST_CASE("deform command: its bench tells cost, a hand's moves, distance and where it bends",
          "[cli]") {
  const Workplace place;
  const std::vector<std::string> words = {"bench", "deform",    place.scene, "--drag",
                                          "4",     "--against", place.scene, "--vertices"};
  const Ending ending = pleat_command(place.folder, words);
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  const Json json = parse_json(ending.out);
  CHECK(json.at("cost").at("status") == "ok");
  CHECK(json.at("cost").at("total_ms") > json.at("cost").at("build_ms"));
  const Json deformed = place.json(place.scene, {});
  CHECK(json.at("cost").at("energy") == deformed.at("steps").back().at("energy"));
  REQUIRE(json.at("drag").at("excess").size() == 4);
  for (const Json& excess : json.at("drag").at("excess")) {
    CHECK(excess.get<double>() > -1e-6);
    CHECK(excess.get<double>() < 0.05);
  }
  CHECK(json.at("against").at("largest_m").get<double>() < 1e-12);
  double bending = 0;
  for (const Json& share : json.at("vertices").at("bending")) bending += share.get<double>();
  CHECK(bending == Approx(json.at("cost").at("terms").at("bending").get<double>()));
}

}  // namespace pleat
