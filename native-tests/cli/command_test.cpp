#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/files/json_text.h"
#include "core/files/obj_file.h"
#include "core/files/whole_file.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/format/start_section.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/matrix_market.h"
#include "native-tests/support/recorded_frames.h"
#include "native-tests/support/small_scene.h"

using namespace pleat;
namespace fs = std::filesystem;

TEST_CASE("command: crossings of the cloth with itself are told where it is asked for", "[cli]") {
  // Two edges of an upright triangle go down through a lying one.
  const SmallScene crossing(R"({"cloth": {"particles": {
    "positions_m": [[0, 0, 0], [3, 0, 0], [0, 0, 3], [1, 1, 0.9], [1, -1, 0.9], [-0.5, -1, 0.9]],
    "masses_kg": [1, 1, 1, 1, 1, 1], "triangles": [[0, 1, 2], [3, 4, 5]]}},
    "world": {"gravity_m_per_s2": [0, 0, 0]}, "record": {"format": "none"}, "duration_s": 0.1})");
  const std::string out = (crossing.folder / "out").string();
  const Ending told = crossing.run({"run", "--out", out});
  CAPTURE(told.error);
  CHECK(told.out.find("crossings of the cloth with itself: 2 in the last frame, at most 2\n") !=
        std::string::npos);
  CHECK_FALSE(parse_json(crossing.run({"run", "--json"}).out).contains("crossings_at_end"));
  const Ending garment = pleat_command(
      crossing.folder, {"run", repository_path("assets/scenes/garments/skirt_walk.json"), "--level",
                        "0", "--steps", "1", "--json"});
  CAPTURE(garment.error);
  CHECK(parse_json(garment.out).at("crossings_at_end") == 0);
}

TEST_CASE("command: run writes the frames and the numbers of the scene", "[cli]") {
  const SmallScene scene;
  const std::string out = (scene.folder / "a/b").string();
  const Ending ending = scene.run({"run", "--out", out, "--json", "--drift"});
  CHECK(ending.error.empty());
  REQUIRE(ending.status == 0);
  const Json metrics = parse_json(text_of(out + "/metrics.json"));
  CHECK(parse_json(ending.out) == metrics);
  CHECK(metrics.at("status") == "ok");
  CHECK(metrics.at("n_steps") == 10);
  CHECK(metrics.at("n_frames") == 6);
  CHECK(metrics.at("n_vertices") == 9);
  CHECK_FALSE(metrics.at("built").empty());
  CHECK_FALSE(metrics.at("left_out").empty());
  CHECK(metrics.at("energy").at("work_of_pins_j") == 0);
  CHECK(metrics.at("crossings_at_end") == 0);
  CHECK(metrics.at("largest_crossings") == 0);
  const RecordedFrames frames = read_frames(out + "/frames.bin");
  REQUIRE(frames.times.size() == 6);
  CHECK(frames.times[5] == Approx(0.2));
  CHECK(frames.positions[0].cols() == 9);
}

TEST_CASE("command: frames of torn cloth have the faces of their time", "[cli]") {
  const SmallScene strip(R"({
    "cloth": {"sheet": {"columns": 2, "rows": 1, "width_m": 0.2, "height_m": 0.1}},
    "fabric": {"name": "fine cotton"}, "model": {"tearing": {"breaking_elongation": 0.2}},
    "pins": [{"part": "left_edge"}, {"part": "right_edge",
              "motion": {"kind": "move", "offset_m": [0.1, 0, 0], "end_s": 0.5}}],
    "record": {"every_s": 0.1, "format": "obj"}, "duration_s": 0.5})");
  const std::string out = (strip.folder / "out").string();
  const Ending ending = strip.run({"run", "--out", out, "--drift", "--json"});
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  const Json metrics = parse_json(ending.out);
  CHECK(metrics.at("n_splits") == 2);
  CHECK(metrics.at("n_vertices") == 8);
  CHECK(metrics.at("energy").at("work_of_tears_j").get<double>() <= 0);
  const ObjMesh first = read_obj(text_of(out + "/frame_000000.obj"));
  const ObjMesh last = read_obj(text_of(out + "/frame_000005.obj"));
  CHECK(first.positions.cols() == 6);
  CHECK(last.positions.cols() == 8);
  CHECK(first.triangles.size() == last.triangles.size());
  CHECK_FALSE(first.triangles == last.triangles);
  CHECK(strip.run({"run"}).out.find("tears: 2 vertices were split") != std::string::npos);
  const Ending dump = strip.run({"run", "--dump", (strip.folder / "dump").string()});
  CHECK(dump.status == 2);
  CHECK(dump.error.find("/model/tearing: expected no such key here") != std::string::npos);
}

TEST_CASE("command: an explicit run says its bound first, and when a solid was first met",
          "[cli]") {
  const SmallScene ball(R"({"cloth": {"particles": {"positions_m": [[0, 1, 0], [0, 2, 0]],
    "masses_kg": [1, 1], "springs": [{"a": 0, "b": 1, "stiffness_n_per_m": 100}]}},
    "world": {"colliders": [{"sphere": {"centre_m": [0, 0, 0], "radius_m": 0.8}}]},
    "method": {"stepper": "explicit", "step_s": 0.01, "substeps": 1, "first_contact_m": 1e-6},
    "record": {"format": "none"}, "duration_s": 0.5})");
  const Ending ending = ball.run({"run"});
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  // h^2 k = 2 m at both of its ends.
  CHECK(ending.error.find("stable in substeps of up to 0.141 s; these are of 0.01 s\n") !=
        std::string::npos);
  CHECK(ending.out.find("first contact at 0.19") != std::string::npos);
  const Json metrics = parse_json(ball.run({"run", "--json"}).out);
  CHECK(metrics.at("stability_bound_s").get<double>() == Approx(std::sqrt(0.02)));
  CHECK(metrics.at("first_contact_s").get<double>() ==
        Approx(std::sqrt(2 * 0.2 / 9.81)).epsilon(0.03));
  const Ending beyond = ball.run({"run", "--step", "0.5"});
  CHECK(beyond.status == 2);
  CHECK(beyond.error.find("/method/substeps: expected substeps of at most 0.141 s") !=
        std::string::npos);
}

TEST_CASE("command: a run tells the energy by its kinds, and which springs are implicit", "[cli]") {
  const SmallScene scene(scene_with("\"step_s\"", "\"stepper\": \"imex\", \"step_s\""));
  const Ending ending = scene.run({"run", "--json", "--drift"});
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  const Json metrics = parse_json(ending.out);
  const Json& energy = metrics.at("energy");
  const auto joules = [&](const char* kind) { return energy.at(kind).get<double>(); };
  CHECK(joules("kinetic_j") > 0);
  CHECK(joules("kinetic_j") + joules("elastic_j") + joules("gravity_j") ==
        Approx(joules("energy_j")));
  const Json& springs = metrics.at("implicit_springs");
  CHECK(springs.at("all") == metrics.at("n_springs"));
  CHECK(springs.at("count") > 0);
  CHECK(springs.at("share").get<double>() ==
        Approx(springs.at("count").get<double>() / springs.at("all").get<double>()));
  const auto map = springs.at("map").get<std::string>();
  CHECK(map.size() == springs.at("all").get<std::size_t>());
  CHECK(std::count(map.begin(), map.end(), '1') == springs.at("count").get<std::ptrdiff_t>());
  CHECK_FALSE(parse_json(SmallScene().run({"run", "--json"}).out).contains("implicit_springs"));
}

TEST_CASE("command: the same scene gives the same bytes", "[cli]") {
  const SmallScene scene;
  for (const char* out : {"one", "two"})
    REQUIRE(scene.run({"run", "--out", (scene.folder / out).string()}).status == 0);
  for (const char* file : {"frames.bin", "metrics.json"})
    CHECK(text_of(scene.folder / "one" / file) == text_of(scene.folder / "two" / file));
}

TEST_CASE("command: a folder that exists keeps what it holds", "[cli]") {
  const SmallScene scene;
  fs::create_directory(scene.folder / "out folder");
  write(scene.folder / "out folder" / "notes.txt", "mine");
  REQUIRE(scene.run({"run", "--out", (scene.folder / "out folder").string()}).status == 0);
  CHECK(text_of(scene.folder / "out folder" / "notes.txt") == "mine");
}

TEST_CASE("command: a scene that begins at the end of a run goes on from there", "[cli]") {
  const SmallScene scene;
  const std::string state = (scene.folder / "state.json").string();
  REQUIRE(scene.run({"run", "--steps", "6", "--state", state}).status == 0);
  write(scene.folder / "scene.json",
        scene_with("\"duration_s\"", R"("start": "state.json", "duration_s")"));
  const Ending ending = scene.run({"run", "--steps", "6", "--state", state, "--overwrite"});
  CAPTURE(ending.error);
  CHECK(ending.status == 2);
  CHECK(ending.error.find("expected another file than those that are read") != std::string::npos);
  const std::string later = (scene.folder / "later.json").string();
  REQUIRE(scene.run({"run", "--steps", "6", "--state", later}).status == 0);
  write(scene.folder / "scene.json", kSmallScene);
  const std::string whole = (scene.folder / "whole.json").string();
  REQUIRE(scene.run({"run", "--steps", "12", "--state", whole}).status == 0);
  const Json in_parts = parse_json(read_file(later));
  const Json at_once = parse_json(read_file(whole));
  // The linear solver starts without what it learnt.
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(in_parts["positions_m"][i][k].get<double>() ==
            Approx(at_once["positions_m"][i][k].get<double>()).margin(1e-5));
}

TEST_CASE("command: a state is written to the last digit, however slow", "[cli]") {
  const SmallScene scene(scene_with("\"step_s\": 0.02", "\"step_s\": 1e-6"));
  const std::string state = (scene.folder / "state.json").string();
  REQUIRE(scene.run({"run", "--steps", "3", "--state", state}).status == 0);
  const Json written = parse_json(read_file(state));
  double fastest = 0;
  for (const Json& velocity : written.at("velocities_m_per_s"))
    fastest = std::max(fastest, std::abs(velocity.at(1).get<double>()));
  CHECK(fastest == Approx(3e-6 * 9.81).epsilon(0.01));
  const Scene read =
      read_scene(scene_with("\"duration_s\"", R"("start": "state.json", "duration_s")"),
                 fabric_library(), [&](const std::string&) { return text_of(state); });
  CHECK(json_start(*read.start) == written);
}

TEST_CASE("command: --dump writes mass and stiffness that other programs read", "[cli]") {
  const SmallScene scene;
  REQUIRE(scene.run({"run", "--dump", (scene.folder / "dump").string()}).status == 0);
  const SparseMatrix mass = read_matrix_market(text_of(scene.folder / "dump" / "mass.mtx"));
  CHECK(mass.rows() == 27);
  CHECK(mass.diagonal().sum() == Approx(3 * 0.114));  // fine cotton, 1 m^2, each axis
  const SparseMatrix begin =
      read_matrix_market(text_of(scene.folder / "dump" / "stiffness_begin.mtx"));
  const SparseMatrix end = read_matrix_market(text_of(scene.folder / "dump" / "stiffness_end.mtx"));
  CHECK(begin.rows() == 27);
  CHECK((begin - end).norm() > 0);
  // A translation of the whole sheet stretches nothing.
  const Eigen::VectorXd shift = Eigen::Vector3d(1, -2, 3).replicate(9, 1);
  const Eigen::VectorXd force = begin.selfadjointView<Eigen::Lower>() * shift;
  CHECK(force.norm() < 1e-9 * begin.norm());
}

TEST_CASE("command: options change the scene", "[cli]") {
  const SmallScene scene;
  const Ending ending = scene.run({"run", "--json", "--level", "1", "--step", "0.01", "--substeps",
                                   "3", "--fabric", "silk", "--steps", "4"});
  REQUIRE(ending.status == 0);
  const Json metrics = parse_json(ending.out);
  CHECK(metrics.at("n_vertices") == 25);
  CHECK(metrics.at("n_substeps") == 3);
  CHECK(metrics.at("fabric") == "silk");
  CHECK(metrics.at("n_steps") == 4);
  CHECK(metrics.at("time_s").get<double>() == Approx(0.04));
}

TEST_CASE("command: more levels than a mesh has are told with the run", "[cli]") {
  const SmallScene scene(scene_with("\"step_s\": 0.02, \"solver\": \"eigen\"",
                                    "\"stepper\": \"multigrid\", \"levels\": 30"));
  const Ending told = scene.run({"run", "--steps", "2"});
  REQUIRE(told.status == 0);
  CHECK_THAT(told.out, Catch::Contains("method: expected 30 coarser levels, got "));
  const Ending ending = scene.run({"run", "--json", "--steps", "2"});
  CHECK_THAT(parse_json(ending.out).at("remark").get<std::string>(),
             Catch::StartsWith("expected 30 coarser levels, got "));
}

TEST_CASE("command: bad input is one sentence that names the place, and exit status 2", "[cli]") {
  struct Bad {
    std::vector<std::string> words;  // words after the scene's file
    std::string place;
  };
  const std::vector<Bad> cases = {
      {{"run", "--step", "-1"}, "--step: "},
      {{"run", "--step", "1e999"}, "--step: "},
      {{"run", "--level", "9"}, "--level: "},
      {{"run", "--level"}, "--level: "},
      {{"run", "--substeps", "0"}, "--substeps: "},
      {{"run", "--iterations", "many"}, "--iterations: "},
      {{"run", "--stepper", "rk9"}, "--stepper: "},
      {{"run", "--fabric", "wol"}, "--fabric: "},
      {{"run", "--steps", "0"}, "--steps: "},
      {{"run", "--duration", "0"}, "--duration: "},
      {{"run", "--fabrics", "/nowhere.json"}, "/nowhere.json: "},
      {{"run", "--nonsense"}, "--nonsense: "},
      {{"run", "another.json"}, "another.json: "},
      {{"run", "--json", "--json"}, "--json: "},
      {{"run", "--out", "/proc/nowhere"}, "/proc/nowhere: "},
      {{"run", "--duraton", "3"}, "--duraton: unknown option; the nearest is --duration"},
      {{"run", "--xyzzy", "3"}, "--xyzzy: unknown option; \"pleat help COMMAND\""},
      {{"run", "--out", ""}, "--out: "},
      {{"run", "--steps", "3", "--duration", "1"}, "--steps: "},
      {{"run", "--stepper", "projective", "--solver", "cg"}, "pleat: --solver: "},
      {{"run", "--stepper", "explicit", "--substeps", "1"}, "pleat: --substeps: "},
      {{"run", "--out", "/dev/null/o", "--duration", "100000"}, "scene.json: /record/every_s: "},
      {{"sweep", "--cache", "/dev/null/c"}, "pleat: /dev/null/c: "},
      {{"sweep", "--out", "/dev/null/c"}, "pleat: /dev/null/c: "},
      {{"sweep", "--levels", "0,1,00"}, "--levels: "},
      {{"sweep", "--steppers", "xpbd,xpbd"}, "--steppers: "},
      {{"sweep", "--duration", "1e7"}, "pleat: --duration: "},
      {{"sweep", "--levels", "0,x"}, "--levels: "},
      {{"sweep", "--levels", "0,,1"}, "--levels: "},
      {{"sweep", "--steppers", "magic"}, "--steppers: "},
      {{"sweep", "--reference", "none"}, "--reference: "},
      {{"sweep", "--repeat", "0"}, "--repeat: "},
      {{"sweep", "--out", "/dev/stdout"}, "pleat: /dev/stdout"},
      {{"sweep", "--overwrite"}, "pleat: --overwrite: expected --out "},
      {{"sweep", "--set", "substeps"}, "pleat: --set: expected a pointer and its values"},
      {{"sweep", "--set", "substeps=1"}, "pleat: --set: in the scene, substeps: expected a JSON "},
      {{"sweep", "--set", "/method/substeps=1,0"}, "pleat: --set: in the scene, /method/substeps"},
      {{"sweep", "--set", "/name=a", "--set", "/name=b"}, "--set: expected each pointer once, "},
      {{"sweep", "--levels", "0", "--set", "/refinement/level=1"}, "pleat: --set: expected each "},
      {{"sweep", "--reference", "rigid_chain", "--set", "/pins=[]"}, "scene.json: /pins: expected"},
      {{"bench"},
       "pleat: bench: expected run, reference, deform, inbetween, plans, together, restarts, "
       "response, rows, limit or depth after it, got "},
      {{"run", "--out", std::string(300, 'x')}, "xxx: expected a folder that can be read, got "},
      {{"run", "--overwrite"}, "pleat: --overwrite: expected --out, "},
      {{"run", "-x"}, "pleat: -x: unknown option"},
      {{"run", "--out", "-x"}, "pleat: --out: expected a value after it, got "},
      {{"run", "--step", "1e-12"}, "pleat: --step: expected at most 1e9 steps "},
      {{"run", "--step", "1e-12", "--duration", "1"}, "pleat: --duration: "},
      {{"sweep", "--steps", "1000000000"}, "pleat: --steps: expected at most 1e9 steps "},
      {{"sweep", "--level", "1", "--levels", "0"}, "pleat: --level: a sweep does not take "},
      {{"sweep", "--stepper", "xpbd"},
       "--stepper: a sweep does not take this option, but --steppers"},
      {{"sweep", "--substeps", "7"}, "pleat: --substeps: a sweep does not take "},
      {{"sweep", "--iterations", "7"}, "pleat: --iterations: a sweep does not take "},
  };
  for (const Bad& bad : cases) {
    const SmallScene scene;
    const Ending ending = scene.run(bad.words);
    CAPTURE(bad.words, ending.error);
    CHECK(ending.status == 2);
    CHECK(ending.out.empty());
    CHECK(ending.error.rfind("pleat: ", 0) == 0);
    CHECK(ending.error.find(bad.place) != std::string::npos);
    CHECK(n_lines(ending.error) == 1);
  }
}

TEST_CASE("command: a bad scene is told with its file and place, and nothing is written", "[cli]") {
  struct Bad {
    std::string text;
    std::string place;
  };
  const std::string whole = kSmallScene;
  const std::vector<Bad> cases = {
      {whole.substr(0, whole.size() / 2), "line 5"},
      {"", "line 1"},
      {scene_with("\"rows\": 2", "\"rows\": 0"), "/cloth/sheet/rows"},
      {scene_with("\"rows\": 2", "\"rows\": \"two\""), "/cloth/sheet/rows"},
      {scene_with("\"step_s\": 0.02", "\"step_s\": NaN"), "line 6"},
      {scene_with("\"step_s\": 0.02", "\"step_s\": 0"), "/method/step_s"},
      {scene_with("\"pins\"", "\"pinz\""), "/pinz"},
  };
  for (const Bad& bad : cases) {
    const ScratchFolder folder;
    write(folder / "bad scene.json", bad.text);
    const Ending ending = pleat_command(
        folder, {"run", (folder / "bad scene.json").string(), "--out", (folder / "o").string()});
    CAPTURE(bad.text, ending.error);
    CHECK(ending.status == 2);
    CHECK(ending.out.empty());
    CHECK(ending.error.find("bad scene.json") != std::string::npos);
    CHECK(ending.error.find(bad.place) != std::string::npos);
    CHECK(n_lines(ending.error) == 1);
    CHECK_FALSE(fs::exists(folder / "o"));
  }
}

TEST_CASE("command: a mesh is read beside the scene that names it, and its faults with its line",
          "[cli]") {
  const ScratchFolder folder;
  const std::string scene = (folder / "scene.json").string();
  write(scene, R"({"cloth": {"mesh": {"obj": "meshes/a mesh.obj", "warp_direction": [0, 1, 0]}},
                   "pins": [{"part": "hem"}]})");
  const auto run = [&] { return pleat_command(folder, {"run", scene, "--steps", "1", "--json"}); };
  const auto is_refused = [&](const std::string& sentence) {
    const Ending ending = run();
    CAPTURE(ending.error);
    CHECK(ending.status == 2);
    CHECK(ending.error.find(sentence) != std::string::npos);
    CHECK(n_lines(ending.error) == 1);
  };
  is_refused("meshes/a mesh.obj: expected a file, got none of this name");
  fs::create_directory(folder / "meshes");
  write(folder / "meshes/a mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
  is_refused("scene.json: meshes/a mesh.obj: line 4: expected the number of a vertex, 1 to 3 ");
  write(folder / "meshes/a mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng waist\nf 1 2 3\n");
  is_refused("scene.json: /pins/0/part: expected one of the groups \"waist\", got \"hem\"");
  write(folder / "meshes/a mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng hem\nf 1 2 3\n");
  const Ending ending = run();
  CHECK(ending.status == 0);
  CHECK(parse_json(ending.out).at("n_pins") == 3);
}

TEST_CASE("command: a run that diverges stops, says where, and keeps the last finite frame",
          "[cli]") {
  const ScratchFolder folder;
  write(folder / "wild.json", kWildScene);
  const Ending ending = pleat_command(
      folder, {"run", (folder / "wild.json").string(), "--out", (folder / "out").string()});
  CAPTURE(ending.error);
  CHECK(ending.status == 1);
  CHECK(ending.error.find("stopped in step ") != std::string::npos);
  CHECK(ending.error.find("vertex ") != std::string::npos);
  const Json metrics = parse_json(text_of(folder / "out" / "metrics.json"));
  CHECK(metrics.at("status") == "not_finite");
  const RecordedFrames frames = read_frames((folder / "out" / "frames.bin").string());
  CHECK(static_cast<int>(frames.times.size()) == metrics.at("n_steps").get<int>() + 1);
  CHECK(frames.positions.back().allFinite());
}

TEST_CASE("command: help and version succeed, no word and unknown words do not hang", "[cli]") {
  const ScratchFolder folder;
  CHECK(pleat_command(folder, {"help"}).status == 0);
  CHECK(pleat_command(folder, {}).out == pleat_command(folder, {"--help"}).out);
  CHECK(pleat_command(folder, {"--version"}).out.rfind("pleat core-", 0) == 0);
  CHECK(pleat_command(folder, {}).status == 0);
  CHECK(pleat_command(folder, {"frob"}).status == 2);
  CHECK(pleat_command(folder, {"run"}).status == 2);
  CHECK(pleat_command(folder, {"run", "/nowhere.json"}).status == 2);
}

TEST_CASE("command: no control character of a scene reaches the terminal", "[cli]") {
  const SmallScene scene(scene_with("\"pins\"", "\"\\u001b[31mred\\nline\\u009b\""));
  const Ending ending = scene.run({"run"});
  CHECK(ending.status == 2);
  CHECK(ending.error.find("/\\u001b[31mred\\u000aline\\u009b: ") != std::string::npos);
  CHECK(n_lines(ending.error) == 1);
  const SmallScene named(scene_with("small sheet", "\\u001b[31mred"));
  CHECK(named.run({"run"}).out.rfind("\\u001b[31mred: ", 0) == 0);
}

TEST_CASE("command: bad input leaves folders that exist as they were", "[cli]") {
  struct Bad {
    std::string text;
    std::vector<std::string> words;  // words after the folders' own
  };
  const std::vector<Bad> cases = {
      {scene_with("\"step_s\": 0.02", "\"step_s\": 0"), {}},
      {scene_with("\"solver\": \"eigen\"", "\"stepper\": \"explicit\", \"substeps\": 1"),
       {"--overwrite"}},
      {kSmallScene, {}},  // the folder holds an earlier run
      {kSmallScene, {"--overwrite", "--level", "99"}},
  };
  for (const Bad& bad : cases) {
    const SmallScene scene(bad.text);
    for (const char* folder : {"out", "dump"}) fs::create_directory(scene.folder / folder);
    for (const char* file : {"out/frames.bin", "out/metrics.json", "out/frame_000007.obj",
                             "dump/mass.mtx", "dump/stiffness_begin.mtx"})
      write(scene.folder / file, file);
    const auto before = contents(scene.folder.path());
    std::vector<std::string> words{"run", "--out", (scene.folder / "out").string(), "--dump",
                                   (scene.folder / "dump").string()};
    words.insert(words.end(), bad.words.begin(), bad.words.end());
    const Ending ending = scene.run(words);
    CAPTURE(bad.text, bad.words, ending.error);
    CHECK(ending.status == 2);
    auto after = contents(scene.folder.path());
    for (const char* file : {"stdout", "stderr"}) after.erase((scene.folder / file).string());
    CHECK(after == before);
  }
}

TEST_CASE("command: nothing is written unless everything can be", "[cli]") {
  const SmallScene scene;
  const std::string good = (scene.folder / "good").string();
  fs::create_directory(good);
  write(good + "/mass.mtx", "mine");
  fs::create_directories(scene.folder / "no metrics" / "metrics.json");
  fs::create_directories(scene.folder / "no rows" / "rows.jsonl");
  fs::create_directories(scene.folder / "no matrix" / "stiffness_end.mtx");
  const std::string no_metrics = (scene.folder / "no metrics").string();
  const std::string no_matrix = (scene.folder / "no matrix").string();
  CHECK(scene.run({"run", "--dump", good, "--out", "/dev/null/o"}).status == 2);
  CHECK(scene.run({"run", "--dump", good, "--out", no_metrics, "--overwrite"}).status == 2);
  CHECK(scene.run({"run", "--dump", no_matrix, "--out", good}).status == 2);
  CHECK(contents(good).size() == 1);
  CHECK(text_of(good + "/mass.mtx") == "mine");
  CHECK(contents(no_metrics).empty());
  CHECK(contents(no_matrix).empty());
  // A sweep is not begun either: it would have kept its reference.
  const std::string cache = (scene.folder / "cache").string();
  CHECK(scene
            .run({"sweep", "--steppers", "implicit", "--repeat", "1", "--cache", cache, "--out",
                  (scene.folder / "no rows").string()})
            .status == 2);
  CHECK((!fs::exists(cache) || fs::is_empty(cache)));
}

TEST_CASE("command: frames of an earlier run are kept, or removed whole", "[cli]") {
  const SmallScene scene;
  const std::string out = (scene.folder / "out").string();
  REQUIRE(scene.run({"run", "--out", out}).status == 0);
  write(out + "/frame_000009.obj", "of an earlier run");
  write(out + "/notes.txt", "mine");
  const Ending refused = scene.run({"run", "--out", out, "--steps", "2"});
  CHECK(refused.status == 2);
  CHECK(refused.error.find("--overwrite") != std::string::npos);
  CHECK(read_frames(out + "/frames.bin").times.size() == 6);
  REQUIRE(scene.run({"run", "--out", out, "--steps", "2", "--overwrite"}).status == 0);
  CHECK(read_frames(out + "/frames.bin").times.size() == 2);
  CHECK_FALSE(fs::exists(out + "/frame_000009.obj"));
  CHECK(text_of(out + "/notes.txt") == "mine");
}

TEST_CASE("command: --fabric replaces a scene's own numbers and keeps its bending", "[cli]") {
  const SmallScene own(scene_with("\"name\": \"fine cotton\"", "\"shear_n_per_m\": 3"));
  CHECK(parse_json(own.run({"run", "--json", "--fabric", "silk"}).out).at("fabric") == "silk");
  const auto stiffness = [](const std::string& fabric, std::vector<std::string> words) {
    const SmallScene scene(scene_with("\"name\": \"fine cotton\"", fabric));
    words.insert(words.begin(), {"run", "--dump", (scene.folder / "d").string()});
    CHECK(scene.run(words).status == 0);
    return text_of(scene.folder / "d" / "stiffness_begin.mtx");
  };
  const std::string silk = "\"name\": \"silk\", \"bending\": \"moving\"";
  const std::string wool = "\"name\": \"wool\", \"bending\": \"moving\"";
  CHECK(stiffness(wool, {"--fabric", "silk"}) == stiffness(silk, {}));
  CHECK(stiffness("\"name\": \"wool\"", {"--fabric", "silk"}) != stiffness(silk, {}));
  CHECK(stiffness(wool, {"--fabric", "denim"}) ==
        stiffness(wool, {"--fabric", "coarse cotton (denim)"}));
}

TEST_CASE("command: --stepper brings that stepper's own settings with it", "[cli]") {
  const std::string method = "\"step_s\": 0.02, \"solver\": \"eigen\"";
  const SmallScene cg(scene_with(method, "\"solver\": \"cg\", \"substeps\": 3"));
  const SmallScene stable(
      scene_with(method, "\"stepper\": \"explicit\", \"substeps\": \"stable\""));
  const auto substeps = [](const SmallScene& scene, const std::string& stepper,
                           const std::vector<std::string>& others = {}) {
    std::vector<std::string> words = {"run", "--json", "--steps", "1", "--stepper", stepper};
    words.insert(words.end(), others.begin(), others.end());
    const Ending ending = scene.run(words);
    CAPTURE(stepper, ending.error);
    REQUIRE(ending.status == 0);
    return parse_json(ending.out).at("n_substeps").get<int>();
  };
  CHECK(substeps(cg, "projective") == 1);
  CHECK(substeps(cg, "xpbd") == 30);
  CHECK(substeps(cg, "xpbd", {"--substeps", "4"}) == 4);
  CHECK(substeps(cg, "explicit") > 3);
  CHECK(substeps(cg, "implicit") == 3);
  CHECK(substeps(stable, "implicit") == 1);
  CHECK(substeps(stable, "explicit") == substeps(cg, "explicit"));
}

TEST_CASE("command: a duration is rounded to whole steps and told as it was", "[cli]") {
  const SmallScene scene;
  const Ending ending = scene.run({"run", "--duration", "0.05"});
  REQUIRE(ending.status == 0);
  CHECK(ending.out.find("3 steps to 0.06 s") != std::string::npos);
  const Ending odd = scene.run({"run", "--step", "0.012345", "--steps", "3"});
  CHECK(odd.out.find("3 steps to 0.037035 s") != std::string::npos);
}

TEST_CASE("command: what chooses its substeps begins with what it will cost", "[cli]") {
  const SmallScene scene;
  for (const char* stepper : {"explicit", "rk4"}) {
    for (const char* reader : {"--drift", "--json"}) {
      CAPTURE(stepper, reader);
      const Ending ending = scene.run({"run", "--stepper", stepper, "--steps", "1", reader});
      REQUIRE(ending.status == 0);
      CHECK(ending.error.rfind(stepper + std::string(", "), 0) == 0);
      CHECK(ending.error.find(" substeps per step, 9 vertices\n") != std::string::npos);
    }
  }
  CHECK(scene.run({"run", "--json", "--steps", "1"}).error.empty());
}

TEST_CASE("command: metrics.json ends with one end of line", "[cli]") {
  const SmallScene scene;
  REQUIRE(scene.run({"run", "--out", (scene.folder / "o").string()}).status == 0);
  const std::string text = text_of(scene.folder / "o" / "metrics.json");
  CHECK(text.substr(text.size() - 2) == "}\n");
}

#ifndef PLEAT_SANITIZED  // the sanitizer needs terabytes of address space itself
TEST_CASE("command: too little memory is told with the number of vertices", "[cli]") {
  const SmallScene scene(
      scene_with("\"columns\": 2, \"rows\": 2", "\"columns\": 999, \"rows\": 999"));
  const Ending ending = pleat_command(scene.folder, {"run", scene.file}, "ulimit -v 200000; ");
  CAPTURE(ending.error);
  CHECK(ending.status == 2);
  CHECK(ending.error.find("scene.json: not enough memory for 1000000 vertices") !=
        std::string::npos);
  std::string blanks;
  blanks.resize(150'000'000, ' ');
  write(scene.file, "[" + blanks);
  const Ending text = pleat_command(scene.folder, {"run", scene.file}, "ulimit -v 200000; ");
  CAPTURE(text.error);
  CHECK(text.status == 2);
  CHECK(text.error.find("scene.json: not enough memory to read it") != std::string::npos);
}
#endif

TEST_CASE("command: what a scene's files have wrong is told with their names", "[cli]") {
  const SmallScene scene(
      scene_with("\"name\": \"small sheet\",", "\"refinement\": {\"level\": 1},"));
  const std::string plan_file = (scene.folder / "plan.json").string();
  REQUIRE(scene.run({"refine", "--out", plan_file}).status == 0);
  const Json plan = parse_json(text_of(plan_file));
  const auto is_refused = [&](const std::string& text, const std::string& sentence) {
    write(scene.folder / "bad.json", text);
    const Ending ending =
        pleat_command(scene.folder, {"run", (scene.folder / "bad.json").string(), "--steps", "1"});
    CAPTURE(sentence, ending.error);
    CHECK(ending.status == 2);
    CHECK(ending.error.find("bad.json: " + sentence) != std::string::npos);
    CHECK(n_lines(ending.error) == 1);
  };
  Json planned = parse_json(kSmallScene);
  planned["refinement"] = {{"plan", "plan.json"}};
  planned["cloth"]["sheet"]["columns"] = 3;
  is_refused(planned.dump(), "plan.json: /base_mesh: expected a plan for this mesh, got one for");
  planned["cloth"]["sheet"]["columns"] = 2;
  Json bad = plan;
  bad["criterion"] = "flatness";
  write(plan_file, bad.dump());
  is_refused(planned.dump(),
             "plan.json: /criterion: expected one of \"shape\", \"curvature\", got \"flatness\"");
  bad = plan;
  bad["splits"][0][0] = 999;
  write(plan_file, bad.dump());
  is_refused(planned.dump(),
             "plan.json: /splits/0: expected a face that can be split here, got 999");

  Json motion = parse_json(text_of(repository_path("assets/motions/turn.json")));
  motion["angles"].erase("knee_flexion_rad");
  write(scene.folder / "motion.json", motion.dump());
  Json walk = parse_json(text_of(repository_path("assets/scenes/garments/skirt_walk.json")));
  walk["figure"]["motion"] = "motion.json";
  is_refused(walk.dump(), "motion.json: /angles: expected the key \"knee_flexion_rad\"");
  walk["figure"]["motion"] = repository_path("assets/motions/turn.json");
  walk["cloth"]["garment"]["skirt"]["waist_ease_m"] = 0.9;
  is_refused(walk.dump(),
             "/cloth/garment/skirt/waist_ease_m: expected 0.000 to 0.175, so that the "
             "waist goes round the body and does not fall over the hips, got 0.9");
}

TEST_CASE("command: --steps counts whatever the step is", "[cli]") {
  const SmallScene scene(scene_with("\"duration_s\": 0.2", "\"duration_s\": 1000"));
  const Ending ending = scene.run({"run", "--json", "--step", "1e-9", "--steps", "10"});
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  CHECK(parse_json(ending.out).at("n_steps") == 10);
  // Rounded, 1e9 times these steps is more than 1e9 steps. The many frames end the run at once.
  for (const char* step : {"0.7", "0.009", "0.018"}) {
    const Ending most = scene.run(
        {"run", "--step", step, "--steps", "1000000000", "--out", (scene.folder / "out").string()});
    CHECK(most.error.find("scene.json: /record/every_s: ") != std::string::npos);
  }
  const SmallScene bad(scene_with("\"duration_s\": 0.2", "\"duration_s\": -1"));
  CHECK(bad.run({"run", "--step", "0.01"}).error.find("scene.json: /duration_s: ") !=
        std::string::npos);
  CHECK(bad.run({"run", "--steps", "1"}).status == 0);
}

TEST_CASE("command: help and version take no words", "[cli]") {
  const ScratchFolder folder;
  CHECK(pleat_command(folder, {"help", "foo"}).status == 2);
  CHECK(pleat_command(folder, {"--version", "x"}).status == 2);
}

TEST_CASE("command: an output that is lost is told, and exit status 1", "[cli]") {
  const SmallScene scene;
  for (const char* command : {"run", "sweep"}) {
    std::vector<std::string> words{command, scene.file, "--json"};
    if (command == std::string("sweep")) words.insert(words.end(), {"--repeat", "1"});
    const Ending ending = pleat_command(scene.folder, words, "", " >/dev/full");
    CHECK(ending.status == 1);
    CHECK(ending.error == "pleat: the output could not be written whole\n");
  }
}

TEST_CASE("command: an output folder that cannot be made leaves none above it", "[cli]") {
  const SmallScene scene;
  fs::create_symlink("loop", scene.folder / "loop");
  const std::string name(300, 'x');
  for (const fs::path& bad : {scene.folder / "new" / name, scene.folder / "loop"}) {
    CHECK(scene.run({"run", "--out", bad.string()}).status == 2);
    CHECK(scene.run({"run", "--dump", bad.string()}).status == 2);
  }
  CHECK_FALSE(fs::exists(scene.folder / "new"));
}
