// Bad input, case by case: the exit status, one sentence that names the place, and not a byte lost.

#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/files/json_text.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/small_scene.h"

using namespace pleat;
namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;
using Files = std::vector<std::pair<std::string, std::string>>;  // names and texts

// Two triangles over a square, and their texture twice as large.
const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string kTextures = "vt 0 0\nvt 2 0\nvt 2 2\nvt 0 2\n";
const std::string kSquare = kCorners + kTextures + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

/// A scene of a mesh, with further keys of the mesh.
std::string mesh_scene(const std::string& name, const std::string& keys = "") {
  return R"({"cloth": {"mesh": {"obj": ")" + name + "\"" + keys + R"(}}, "duration_s": 0.1})";
}

std::string placed_scene(const std::string& keys) {
  return R"({"cloth": {"mesh": {"positions_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
             "triangles": [[0, 1, 2]])" +
         keys + "}}}";
}

std::string deform_scene(const std::string& mesh_keys) {
  return R"({"cloth": {"mesh": {)" + mesh_keys + R"(}}, "fabric": "wool",
             "pins": [{"vertices": [0, 1, 2]}]})";
}

/// A folder with a scene, a mesh and a deformation in it, from which the command is called, so that
/// it tells names as they are given.
struct Desk {
  ScratchFolder folder;

  explicit Desk(const Files& files = {}) {
    put({{"scene.json", kSmallScene},
         {"mesh.obj", kSquare},
         {"mesh.json", mesh_scene("mesh.obj")},
         {"deform.json", deform_scene(R"("obj": "mesh.obj")")}});
    put(files);
  }
  void put(const Files& files) const {
    for (const auto& [name, text] : files) {
      fs::create_directories((folder / name).parent_path());
      write(folder / name, text);
    }
  }
  Ending call(const Words& words, const std::string& limits = "") const {
    return pleat_command(folder, words, "cd '" + folder.path().string() + "'; " + limits);
  }
  /// Every file and what is in it, but what the shell writes.
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> texts;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
      texts[entry.path().string()] = entry.is_regular_file() ? text_of(entry.path()) : "";
    for (const char* own : {"stdout", "stderr"}) texts.erase((folder / own).string());
    return texts;
  }
};

struct Bad {
  Words words;
  std::string sentence;  // start of what is told, after "pleat: "
  Files files;           // files beside those of any desk
};

void check_refused(const Bad& bad) {
  const Desk desk(bad.files);
  const auto before = desk.contents();
  const Ending ending = desk.call(bad.words);
  CAPTURE(bad.words, bad.sentence, ending.error, ending.out);
  CHECK(ending.status == 2);
  CHECK(ending.out.empty());
  CHECK(ending.error.rfind("pleat: " + bad.sentence, 0) == 0);
  CHECK(n_lines(ending.error) == 1);
  CHECK(desk.contents() == before);
}

}  // namespace

TEST_CASE("bad input: words that are no options, options or values too many", "[cli]") {
  const Bad cases[] = {
      {{"run", "scene.json", "--step="}, "--step: expected a value after it, got an empty one", {}},
      {{"run", "scene.json", "--step=x"}, "--step: expected a number > 0.0, got \"x\"", {}},
      {{"run", "scene.json", "--step=0.1", "--step", "0.2"},
       "--step: expected this option once",
       {}},
      {{"run", "scene.json", "--step", "--level=1"},
       "--step: expected a value after it, got none",
       {}},
      {{"run", "scene.json", "--json=1"}, "--json: expected no value, got \"--json=1\"", {}},
      {{"run", "scene.json", "--stp=0.1"}, "--stp: unknown option; the nearest is --step", {}},
      {{"run", "scene.json", "--colour=1"},
       "--colour: unknown option; \"pleat help COMMAND\" lists",
       {}},
      {{"run", "scene.json", "--"}, "--: unknown option", {}},
      {{"run", "scene.json", "--level=9"}, "--level: expected a whole number from 0 to 8", {}},
      {{"run", "scene.json", "mesh.json"}, "mesh.json: one word too many", {}},
      {{"sweep", "scene.json", "--set", "=1"}, "--set: expected a pointer and its values", {}},
      {{"sweep", "scene.json", "--set=/name"}, "--set: expected a pointer and its values", {}},
      {{"sweep", "scene.json", "--levels=0,,1"}, "--levels: ", {}},
      {{"sweep", "scene.json", "--level=1"}, "--level: a sweep does not take this option", {}},
      {{"deform", "deform.json", "--overwrite"}, "--overwrite: expected --out beside it", {}},
      {{"refine", "scene.json", "--overwrite"}, "--overwrite: expected --out beside it", {}},
      {{"sweep", "scene.json", "--keep-level=1"},
       "--keep-level: expected --ship-references beside it",
       {}},
      {{"sweep", "scene.json", "--ship-references=r", "--json"},
       "--ship-references: makes no rows for --out and --json",
       {}},
      {{"reference", "scene.json", "--overwrite"}, "--overwrite: expected --out beside it", {}},
      {{"run", "scene.json", "--overwrite"},
       "--overwrite: expected --out, --dump or --state beside it",
       {}},
  };
  for (const Bad& bad : cases) check_refused(bad);
}

TEST_CASE("bad input: devices, folders and endless files are not read", "[cli]") {
  const Bad cases[] = {
      {{"run", "/dev/zero"}, "/dev/zero: expected a file, got a device", {}},
      {{"run", "/dev/null"}, "/dev/null: expected a file, got a device", {}},
      {{"run", "scene.json", "--fabrics", "/dev/zero"},
       "/dev/zero: expected a file, got a dev",
       {}},
      {{"run", "scene.json", "--fabrics=/dev/urandom"}, "/dev/urandom: expected a file, got a", {}},
      {{"deform", "/dev/zero"}, "/dev/zero: expected a file, got a device", {}},
      {{"sweep", "/dev/zero"}, "/dev/zero: expected a file, got a device", {}},
      {{"bench", "rows", "/dev/zero"}, "/dev/zero: expected a file, got a device", {}},
      {{"refine", "scene.json", "--merge", "/dev/zero"}, "/dev/zero: expected a file, got a", {}},
      {{"run", "."}, ".: expected a file, got a folder", {}},
      {{"run", "bad.json"},
       "/dev/zero: expected a file, got a device",
       {{"bad.json", mesh_scene("/dev/zero")}}},
      {{"run", "bad.json"}, ".: expected a file, got a folder", {{"bad.json", mesh_scene(".")}}},
      {{"bench", "rows", "nope.json"}, "nope.json: expected a file, got none of this name", {}},
      {{"refine", "nope.json"}, "nope.json: expected a file, got none of this name", {}},
      {{"bench", "rows", "bad.json"},
       "bad.json: line 1, column 2: expected JSON",
       {{"bad.json", "{"}}},
  };
  for (const Bad& bad : cases) check_refused(bad);
  const Desk desk;
  for (const char* name : {"huge.json", "huge.obj"}) {
    desk.put({{name, ""}});
    fs::resize_file(desk.folder / name, (std::uintmax_t{1} << 30) + 1);  // takes no place
  }
  for (const Words& words :
       {Words{"run", "huge.json"}, Words{"deform", "huge.obj", "--fabric=silk"},
        Words{"run", "scene.json", "--fabrics=huge.json"}}) {
    const Ending ending = desk.call(words);
    CAPTURE(words);
    CHECK(ending.status == 2);
    CHECK(ending.error.rfind("pleat: huge.", 0) == 0);
    CHECK(ending.error.find(": expected a file of at most 1 GiB, got more\n") != std::string::npos);
  }
}

TEST_CASE("bad input: a name that is none, and a key far from all, are told where they stand",
          "[cli]") {
  const std::string walk = repository_path("assets/scenes/garments/skirt_walk.json");
  Json unmoved = parse_json(text_of(walk));
  unmoved["figure"]["motion"] = "nope.json";
  Json nameless = unmoved;
  nameless["figure"]["motion"] = "";
  const Bad cases[] = {
      {{"run", "bad.json"},
       "bad.json: /cloth/mesh/obj: expected the name of a file, got \"\"",
       {{"bad.json", mesh_scene("")}}},
      {{"run", "bad.json"},
       "bad.json: /cloth/mesh/obj: expected the name of a file, got \"mesh",
       {{"bad.json", mesh_scene("mesh.obj\\u0000zzz")}}},
      {{"deform", "bad.json"},
       "bad.json: /cloth/mesh/obj: expected the name of a file, got \"\"",
       {{"bad.json", deform_scene(R"("obj": "")")}}},
      {{"run", "bad.json"},
       "nope.obj: expected a file, got none of this name",
       {{"bad.json", mesh_scene("nope.obj")}}},
      {{"run", "below/bad.json"},
       "below/mesh.obj: expected a file, got none of this name",
       {{"below/bad.json", mesh_scene("mesh.obj")}}},
      {{"run", "bad.json"},
       "nope.json: expected a file, got none of this name",
       {{"bad.json", unmoved.dump()}}},
      {{"run", "bad.json"},
       "bad.json: /figure/motion: expected the name of a file, got \"\"",
       {{"bad.json", nameless.dump()}}},
      {{"run", "bad.json"},
       "nope.json: expected a file, got none of this name",
       {{"bad.json", scene_with("\"pins\"", R"("refinement": {"plan": "nope.json"}, "pins")")}}},
      {{"run", "bad.json"},
       "bad.json: /refinement/plan: expected the name of a file, got \"\"",
       {{"bad.json", scene_with("\"pins\"", R"("refinement": {"plan": ""}, "pins")")}}},
      {{"run", "bad.json"},
       "bad.json: scene.json: /name: expected ",
       {{"bad.json", scene_with("\"pins\"", R"("refinement": {"plan": "scene.json"}, "pins")")}}},
      {{"run", "bad.json"},
       "bad.json: /colour: expected one of the keys ",
       {{"bad.json", scene_with("\"pins\"", R"("colour": "red", "pins")")}}},
      {{"run", "bad.json"},
       "bad.json: /pnis: expected ",
       {{"bad.json", scene_with("pins", "pnis")}}},
      {{"run", "bad.json"},
       "bad.json: mesh.bad: line 1: expected a number, got \"x\"",
       {{"bad.json", mesh_scene("mesh.bad")}, {"mesh.bad", "v 0 0 x\n"}}},
  };
  for (const Bad& bad : cases) check_refused(bad);
}

TEST_CASE("bad input: what no cloth can be made of is told with its line", "[cli]") {
  const std::string texture = R"(, "rest": "texture")";
  const auto rested = [&](const std::string& obj) {
    return Files{{"bad.json", mesh_scene("bad.obj", texture)}, {"bad.obj", obj}};
  };
  const std::string crossing =
      "expected a polygon that can be split into triangles about its first";
  const Bad cases[] = {
      {{"deform", "bad.obj", "--fabric=silk"},
       "bad.obj: line 5: " + crossing,
       {{"bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3 4\n"}}},
      {{"deform", "bad.obj", "--fabric=silk"},
       "bad.obj: line 5: " + crossing,
       {{"bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 3 3 0\nf 1 2 3 4\n"}}},
      {{"run", "bad.json"},
       "bad.json: bad.obj: line 5: " + crossing,
       {{"bad.json", mesh_scene("bad.obj")}, {"bad.obj", kCorners + "f 2 3 1 4\n"}}},
      {{"deform", "bad.obj", "--fabric=silk"},
       "bad.obj: expected vertices (v), got none",
       {{"bad.obj", "seam 1 2\nseam 2 3\n"}}},
      {{"deform", "bad.obj", "--fabric=silk"},
       "bad.obj: expected vertices (v), got none",
       {{"bad.obj", kSmallScene}}},
      {{"deform", "bad.obj", "--fabric=silk"},
       "bad.obj: line 1: expected triangles or polygons (f)",
       {{"bad.obj", "cstype bezier\n"}}},
      {{"run", "bad.json"},
       "bad.json: bad.obj: line 5: expected texture coordinates, of which ",
       rested(kCorners + "f 1 2 3\nf 1 3 4\n")},
      {{"run", "bad.json"},
       "bad.json: bad.obj: line 10: expected texture coordinates, of which ",
       rested(kCorners + kTextures + "f 1/1 2/2 3/3\nf 1 3 4\n")},
      {{"run", "bad.json"},
       "bad.json: bad.obj: line 10: expected a triangle with an area in the ",
       rested(kCorners + kTextures + "f 1/1 2/2 3/3\nf 1/1 3/1 4/4\n")},
      {{"run", "bad.json"},
       "bad.json: bad.obj: line 9: expected a triangle wound alike in the mesh",
       rested(kCorners + kTextures + "f 1/1 2/4 3/3\nf 1/1 3/3 4/2\n")},
      {{"run", "bad.json"},
       "bad.json: /cloth/mesh/rest: expected one of \"positions\", \"texture\"",
       {{"bad.json", mesh_scene("mesh.obj", R"(, "rest": "flat")")}}},
      {{"run", "bad.json"},
       "bad.json: /cloth/mesh/texture_scale_m: expected a number > 0",
       {{"bad.json", mesh_scene("mesh.obj", texture + R"(, "texture_scale_m": 0)")}}},
      {{"run", "bad.json"},
       "bad.json: /cloth/mesh/texture_scale_m: expected no such key without",
       {{"bad.json", mesh_scene("mesh.obj", R"(, "texture_scale_m": 1)")}}},
      {{"run", "bad.json"},
       "bad.json: /cloth/mesh/warp_direction: expected no such key with",
       {{"bad.json", mesh_scene("mesh.obj", texture + R"(, "warp_direction": [1, 0, 0])")}}},
      {{"run", "bad.json"},
       "bad.json: /cloth/mesh/pattern_m: expected an array of 1 values",
       {{"bad.json", placed_scene(R"(, "pattern_m": [])")}}},
      {{"run", "bad.json"},
       "bad.json: /cloth/mesh/pattern_m/0: expected a triangle wound alike",
       {{"bad.json", placed_scene(R"(, "pattern_m": [[[0, 0], [0, 1], [1, 0]]])")}}},
      {{"run", "bad.json"},
       "bad.json: /cloth/mesh/pattern_m/0/2: expected an array of 2 values",
       {{"bad.json", placed_scene(R"(, "pattern_m": [[[0, 0], [0, 1], [1]]])")}}},
      {{"run", "bad.json"},
       "bad.json: /cloth/mesh/triangles/0: expected texture coordinates, of",
       {{"bad.json", placed_scene(texture)}}},
      {{"deform", "bad.json"},
       "bad.json: /cloth/mesh/rest: expected no such key, as shapes of ",
       {{"bad.json", deform_scene(R"("obj": "mesh.obj", "rest": "texture")")}}},
  };
  for (const Bad& bad : cases) check_refused(bad);
}

TEST_CASE("bad input: settings that a method does not read are refused", "[cli]") {
  const auto method = [](const std::string& keys) {
    return Files{{"bad.json", scene_with("\"step_s\": 0.02, \"solver\": \"eigen\"", keys)}};
  };
  const Bad cases[] = {
      {{"run", "bad.json"},
       "bad.json: /method/rule: expected no such key, as implicit does not ",
       method(R"("stepper": "implicit", "rule": "equilibrium")")},
      {{"run", "bad.json"},
       "bad.json: /method/iterations: expected no such key, as implicit does ",
       method(R"("stepper": "implicit", "iterations": 77)")},
      {{"run", "bad.json"},
       "bad.json: /method/tolerance: expected no such key, as explicit does n",
       method(R"("stepper": "explicit", "tolerance": 0.1)")},
      {{"run", "scene.json", "--stepper=explicit", "--tolerance=0.1"},
       "--tolerance: expected no such key, as explicit does not read it",
       {}},
      {{"run", "scene.json", "--stepper=xpbd", "--solver=cg"},
       "--solver: expected no such key, as xpbd does not read it",
       {}},
  };
  for (const Bad& bad : cases) check_refused(bad);
}

TEST_CASE("bad input: what stands there is written over only when asked, and what is read never",
          "[cli]") {
  const std::string there = ": expected a name that no file has, got one that has; --overwrite ";
  const std::string read = ": expected another file than those that are read, got one of them";
  const std::string fabrics = repository_file("assets/fabrics/fabrics.json");
  const Bad cases[] = {
      {{"deform", "deform.json", "--out", "old.obj"}, "old.obj" + there, {{"old.obj", "mine"}}},
      {{"reference", "scene.json", "--out=old"}, "old" + there, {{"old", "mine"}}},
      {{"refine", "scene.json", "--out", "old"}, "old" + there, {{"old", "mine"}}},
      {{"run", "scene.json", "--dump", "d"},
       "d/stiffness_end.mtx" + there,
       {{"d/stiffness_end.mtx", "mine"}}},
      {{"run", "scene.json", "--out", "o"},
       "o: expected a folder without a run's files",
       {{"o/frames.bin.part", "mine"}}},
      {{"deform", "deform.json", "--out", "mesh.obj", "--overwrite"}, "mesh.obj" + read, {}},
      {{"deform", "deform.json", "--out", "deform.json", "--overwrite"}, "deform.json" + read, {}},
      {{"deform", "mesh.obj", "--fabric=silk", "--out=./mesh.obj", "--overwrite"},
       "./mesh.obj" + read,
       {}},
      {{"deform", "mesh.obj", "--fabric=silk", "--out=mesh.obj"}, "mesh.obj" + read, {}},
      {{"reference", "scene.json", "--out=scene.json", "--overwrite"}, "scene.json" + read, {}},
      {{"reference", "scene.json", "--fabrics=f.json", "--out=f.json", "--overwrite"},
       "f.json" + read,
       {{"f.json", fabrics}}},
      {{"refine", "scene.json", "--out=scene.json", "--overwrite"}, "scene.json" + read, {}},
      {{"refine", "scene.json", "--merge=b.json", "--out=b.json", "--overwrite"},
       "b.json" + read,
       {{"b.json", kSmallScene}}},
      {{"run", "o/metrics.json", "--out=o", "--overwrite"},
       "o/metrics.json" + read,
       {{"o/metrics.json", kSmallScene}}},
      {{"run", "mesh.json", "--out=o", "--overwrite"},
       "o/frame_000001.obj" + read,
       {{"mesh.json", mesh_scene("o/frame_000001.obj")}, {"o/frame_000001.obj", kSquare}}},
      {{"run", "d/mass.mtx", "--dump=d", "--overwrite"},
       "d/mass.mtx" + read,
       {{"d/mass.mtx", kSmallScene}}},
      {{"sweep", "o/plan.json", "--out=o", "--overwrite"},
       "o/plan.json" + read,
       {{"o/plan.json", std::string(R"({"scene": )") + kSmallScene + "}"}}},
  };
  for (const Bad& bad : cases) check_refused(bad);
}

TEST_CASE("bad input: of several examples the one at fault is named", "[cli]") {
  const std::string wild = scene_with("\"pins\"", R"("world": {"air": {"density_kg_per_m3": 1e5}},
      "pins")");
  Json explosive = parse_json(wild);
  explosive["cloth"]["sheet"]["initial_velocity_m_per_s"] = {0, 30, 0};
  explosive["method"] = {{"stepper", "explicit"}, {"substeps", "stable"}};
  const Bad cases[] = {
      {{"refine", "scene.json", "--merge", "b.json"},
       "b.json: /cloth: expected examples of one cloth at one level",
       {{"b.json", scene_with("\"columns\": 2", "\"columns\": 3")}}},
      {{"refine", "scene.json", "--merge", "b.json"},
       "b.json: /cloth: expected a sheet or",
       {{"b.json", mesh_scene("mesh.obj")}}},
      {{"refine", "scene.json", "--merge", "b.json"},
       "b.json: /duration_s: expected at least two",
       {{"b.json", scene_with("\"duration_s\": 0.2", "\"duration_s\": 0.03")}}},
      {{"refine", "scene.json", "--merge", "b.json"},
       "b.json: expected an example that runs to",
       {{"b.json", explosive.dump()}}},
  };
  for (const Bad& bad : cases) check_refused(bad);
}

TEST_CASE("input: an option and its value may be one word", "[cli]") {
  const Desk desk;
  const Ending joined = desk.call({"run", "scene.json", "--json", "--step=0.05", "--steps=2"});
  CAPTURE(joined.error);
  REQUIRE(joined.status == 0);
  CHECK(joined.out ==
        desk.call({"run", "scene.json", "--json", "--step", "0.05", "--steps", "2"}).out);
  const Ending set =
      desk.call({"sweep", "scene.json", "--json", "--repeat=1", "--set=/method/substeps=1,2"});
  CHECK(set.status == 0);
  CHECK(n_lines(set.out) == 2);
}

TEST_CASE("input: bytes that are no text stand in for a commit, and are told as such", "[cli]") {
  const Desk desk;
  const Ending ending = desk.call(
      {"sweep", "scene.json", "--json", "--repeat=1", "--steppers=implicit", "--commit", "a\xff"});
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  CHECK(ending.out.find("\"commit\":\"a\xef\xbf\xbd\"") != std::string::npos);
}

TEST_CASE("input: statements of other programs in an OBJ are skipped with one warning", "[cli]") {
  const Desk desk({{"foreign.obj", "# garment\nseam 1 2\n" + kSquare + "seam 2 3\nfoo\n"},
                   {"foreign.json", mesh_scene("foreign.obj")},
                   {"bends.json", deform_scene(R"("obj": "foreign.obj")")}});
  const std::string told =
      "foreign.obj: skipped 3 statements that Pleat does not use (seam, 2; foo, 1)\n";
  for (const Words& words : {Words{"run", "foreign.json", "--json", "--steps=1"},
                             Words{"deform", "bends.json", "--json"},
                             Words{"deform", "foreign.obj", "--fabric=wool", "--json"}}) {
    const Ending ending = desk.call(words);
    CAPTURE(words);
    CHECK(ending.status == 0);
    CHECK(ending.error == told);
  }
  CHECK(desk.call({"run", "mesh.json", "--json", "--steps=1"}).error.empty());
}

TEST_CASE("output: --overwrite replaces the file of every command that writes one", "[cli]") {
  const Desk desk({{"old", "mine"}, {"d/mass.mtx", "mine"}});
  for (const Words& words :
       {Words{"deform", "deform.json", "--out=old", "--overwrite"},
        Words{"reference", "scene.json", "--step=0.01", "--every=0.1", "--out=old", "--overwrite"},
        Words{"refine", "scene.json", "--level=1", "--out=old", "--overwrite"}}) {
    const std::string before = text_of(desk.folder / "old");
    const Ending ending = desk.call(words);
    CAPTURE(words, ending.error);
    CHECK(ending.status == 0);
    CHECK(text_of(desk.folder / "old") != before);
  }
  CHECK(desk.call({"run", "scene.json", "--dump=d", "--overwrite"}).status == 0);
  CHECK(text_of(desk.folder / "d/mass.mtx").rfind("%%MatrixMarket", 0) == 0);
}

TEST_CASE("output: one that is lost on the way is told, and passes for no whole one", "[cli]") {
  const Desk desk;
  // A few blocks of 512 bytes: of a frame's 224 bytes, many more than are there.
  const std::string full = "ulimit -f 2; ";
  const Ending run = desk.call({"run", "scene.json", "--out=o"}, full);
  CAPTURE(run.error);
  CHECK(run.status == 1);
  CHECK(run.error.find(
            "o/frames.bin.part: the output could not be written whole, but 4 frames wer") !=
        std::string::npos);
  CHECK_FALSE(fs::exists(desk.folder / "o/frames.bin"));
  CHECK_FALSE(fs::exists(desk.folder / "o/metrics.json"));
  const Ending reference =
      desk.call({"reference", "scene.json", "--step=0.01", "--out=r"}, "ulimit -f 1; ");
  CAPTURE(reference.error);
  CHECK(reference.status == 1);
  CHECK(reference.error.rfind("pleat: r: the output could not be written whole, ", 0) == 0);
  CHECK_FALSE(fs::exists(desk.folder / "r"));
}
