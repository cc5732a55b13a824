#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "core/files/json_text.h"
#include "native-tests/support/small_scene.h"

using namespace pleat;

TEST_CASE("command: a bench that the numbers end says so, with the frames that ran", "[cli]") {
  const ScratchFolder folder;
  write(folder / "wild.json", kWildScene);
  const std::string file = (folder / "wild.json").string();
  const Ending run = pleat_command(folder, {"bench", "run", file, "--frames", "60"});
  CHECK(run.status == 1);
  CHECK(run.error.rfind("pleat: stopped in step ", 0) == 0);
  const Json json = parse_json(run.out);
  CHECK(json.at("status") == "not_finite");
  CHECK(json.at("rms_stretch").size() < 59);
  CHECK(json.at("ms").size() + 1 == json.at("rms_stretch").size());
  CHECK(json.at("first_ms").get<double>() > 0);
  const Ending reference = pleat_command(folder, {"bench", "reference", file, "--times", "1"});
  CHECK(reference.status == 1);
  CHECK(reference.out.empty());
  CHECK(reference.error.find("ended early") != std::string::npos);
}

TEST_CASE("command: a bare bench moves as the run does, and refuses what is more than springs",
          "[cli]") {
  const SmallScene scene;
  const auto bench = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"bench", "run", scene.file, "--frames", "12"};
    words.insert(words.end(), {"--times", "0.1,0.2", "--step", "0.016666666666666666"});
    words.insert(words.end(), more.begin(), more.end());
    return pleat_command(scene.folder, words);
  };
  CHECK(bench({"--bare"}).status == 2);
  CHECK(bench({"--bare"}).error.find("--bare: expected a scene of springs") != std::string::npos);
  Json limp = parse_json(text_of(scene.file));
  limp["model"] = {{"bending", "none"}};
  write(scene.file, limp.dump());
  const Json whole = parse_json(bench({}).out);
  const Json bare = parse_json(bench({"--bare"}).out);
  REQUIRE(whole.at("samples").size() == 2);
  CHECK(bare.at("samples") == whole.at("samples"));
}

TEST_CASE("command: bench rows have speed, error and reference of every run", "[cli]") {
  const SmallScene scene(scene_with("0.02", "0.016666666666666666"));
  const auto ask = [&](const char* kind, std::vector<std::string> words) {
    words.insert(words.begin(), {"bench", kind, scene.file});
    const Ending ending = pleat_command(scene.folder, words);
    CAPTURE(ending.error);
    REQUIRE(ending.status == 0);
    return parse_json(ending.out);
  };
  const Json right = ask("reference", {"--times", "0.05,0.1", "--halved"});
  for (const Json& sample : right.at("samples"))
    CHECK(sample.at("halving_changed_m").get<double>() > 0);
  CHECK(right.at("reference").at("uncertainty_m") ==
        right.at("samples").back().at("halving_changed_m"));
  Json run = ask("run", {"--frames", "6", "--times", "0.05,0.1"});
  Json moved = run;
  for (Json& x : moved.at("samples").at(1).at("positions_m")) x = x.get<double>() + 1;
  moved.at("samples").erase(0);  // it came to one time alone, and is compared there
  for (Json& ms : moved.at("processor_ms")) ms = 3;
  for (Json& ms : run.at("processor_ms")) ms = 2;
  const auto contestant = [&](const char* label, const Json& shown) {
    return Json{{"label", label},
                {"scene", "small"},
                {"method", shown.at("method")},
                {"n_vertices", shown.at("n_vertices")},
                {"runs", {shown}}};
  };
  Json asked = right;
  asked["times_s"] = {0.05, 0.1};
  asked["turn_frames"] = 2;
  asked["commit"] = "c";
  asked["contestants"] = {contestant("own", run), contestant("moved", moved)};
  const std::string file = (scene.folder / "runs.json").string();
  write(file, asked.dump());
  const Ending ending = pleat_command(scene.folder, {"bench", "rows", file});
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  const std::size_t end = ending.out.find('\n');
  const Json own = parse_json(ending.out.substr(0, end));
  const Json other = parse_json(ending.out.substr(end + 1));
  CHECK(own.at("reference") == right.at("reference"));
  CHECK(own.at("status") == "ok");
  CHECK(own.at("ms_per_frame").get<double>() > 0);
  CHECK(own.at("position_error_m").get<double>() < 1e-12);
  CHECK(other.at("position_errors_m").at("0.05 s").get<double>() > 0.5);
  CHECK(other.at("position_error_m").is_null());
  CHECK(other.at("times_as_long_as_first") == 1.5);

  asked.at("samples").at(1).at("positions_m").at(0) = Json();
  write(file, asked.dump());
  const Ending unknown = pleat_command(scene.folder, {"bench", "rows", file});
  REQUIRE(unknown.status == 0);
  CHECK(parse_json(unknown.out.substr(0, unknown.out.find('\n'))).at("position_error_m").is_null());

  asked.at("reference").at("id") = "";
  write(file, asked.dump());
  const Ending nameless = pleat_command(scene.folder, {"bench", "rows", file});
  CHECK(nameless.status == 2);
  CHECK(nameless.error.find("runs.json: /reference/id: ") != std::string::npos);
}

TEST_CASE("command: bench limit tells where three meshes lead, and that some lead nowhere",
          "[cli]") {
  const ScratchFolder folder;
  const auto answer = [&](std::array<double, 3> heights) {
    Json meshes = Json::array();
    for (const double height : heights) meshes.push_back({{{"positions_m", {0.0, height, 0.0}}}});
    write(folder / "runs.json", Json{{"masses_kg", {1}}, {"meshes", meshes}}.dump());
    const Ending ending =
        pleat_command(folder, {"bench", "limit", (folder / "runs.json").string()});
    CAPTURE(ending.error);
    REQUIRE(ending.status == 0);
    return parse_json(ending.out).at("samples").at(0);
  };
  const Json limit = answer({4, 2, 1});
  CHECK(limit.at("positions_m").at(1).get<double>() == Approx(0).margin(1e-12));
  CHECK(limit.at("rate").get<double>() == Approx(1));
  CHECK(answer({1, 2, 4}).at("positions_m").at(1).is_null());
}

TEST_CASE("command: bench response runs a scene under both responses", "[cli]") {
  const SmallScene ball(
      R"({"cloth": {"sheet": {"columns": 4, "rows": 4, "origin_m": [-0.4, 0.85, -0.5],
    "warp_direction": [1, 0, 0], "weft_direction": [0, 0, 1]}}, "fabric": {"name": "linen"},
    "world": {"colliders": [{"sphere": {"centre_m": [0, 0, 0], "radius_m": 0.8}}]},
    "method": {"stepper": "explicit"}, "duration_s": 0.5})");
  const Ending ending =
      pleat_command(ball.folder, {"bench", "response", ball.file, "--window", "0.01"});
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  const Json found = parse_json(ending.out);
  const auto speed = [&](const char* response) {
    return found.at(response).at("rms_normal_velocity_m_per_s").get<double>();
  };
  CHECK(speed("resting") < speed("uniform"));
  CHECK(found.at("window_s") == 0.01);
  CHECK(found.at("resting").at("momentum_deviation").get<double>() < 1e-9);
  const SmallScene without;
  const Ending bare = pleat_command(without.folder, {"bench", "response", without.file});
  CHECK(bare.status == 2);
  CHECK(bare.error.find("scene.json: /world/colliders: expected a solid") != std::string::npos);
}

TEST_CASE("command: a spring hangs as far down as its closed form says", "[cli]") {
  const ScratchFolder folder;
  write(folder / "hanging.json", R"({
    "cloth": {"particles": {"positions_m": [[0, 0, 0], [1, 0, 0]], "masses_kg": [1, 0.5],
              "springs": [{"a": 0, "b": 1, "stiffness_n_per_m": 20}]}},
    "pins": [{"vertices": [0]}],
    "world": {"gravity_m_per_s2": [0, -8, 0]}
  })");
  const std::string file = (folder / "hanging.json").string();
  const Ending ending =
      pleat_command(folder, {"bench", "reference", file, "--kind", "closed_form", "--times", "1"});
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  const Json json = parse_json(ending.out);
  CHECK(json.at("reference").at("converged") == true);
  const Json& x = json.at("samples").at(0).at("positions_m");
  CHECK(x.at(3).get<double>() == Approx(0).margin(1e-12));
  CHECK(x.at(4).get<double>() == Approx(-1.2).epsilon(1e-12));  // 1 m and 0.5 kg x 8 m/s^2 / 20 N/m
}

TEST_CASE("command: meshes are told by their own fault, by restarts and by folds", "[cli]") {
  const SmallScene scene;
  const auto at_level = [&](int level) {
    Json json = parse_json(kSmallScene);
    json["refinement"] = {{"level", level}};
    json["duration_s"] = 0.4;
    json["method"]["step_s"] = 1.0 / 60;
    const auto file = scene.folder / ("level" + std::to_string(level) + ".json");
    write(file, json.dump());
    return file.string();
  };
  const auto bench = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "bench");
    words.insert(words.end(), {at_level(2), "--with", at_level(2) + "," + at_level(0)});
    return pleat_command(scene.folder, words);
  };
  const Ending together = bench({"together"});
  CAPTURE(together.error);
  REQUIRE(together.status == 0);
  const Json runs = parse_json(together.out).at("runs");
  CHECK(runs.at(1).at("errors").at("sampling_m") == 0);
  CHECK(runs.at(2).at("errors").at("sampling_m").get<double>() > 1e-6);
  CHECK(runs.at(2).at("errors").at("sampling_rad").get<double>() > 1e-4);
  CHECK(runs.at(2).at("folds_m").empty());  // a sheet has no rings
  const Ending restarts = bench({"restarts", "--every", "0.2", "--after", "0.1"});
  CAPTURE(restarts.error);
  REQUIRE(restarts.status == 0);
  const Json rows = parse_json(restarts.out).at("restarts");
  REQUIRE(rows.at(1).at("errors_m").size() == 2);
  CHECK(rows.at(0).at("errors_m").at(0).get<double>() < 1e-6);
  CHECK(rows.at(1).at("errors_m").at(0).get<double>() > 1e-5);
  CHECK(bench({"restarts", "--every", "0.1", "--after", "0.2"}).status == 2);
}

TEST_CASE("command: a bench refuses what it would not use", "[cli]") {
  const SmallScene scene;
  struct Bad {
    std::string kind;
    std::vector<std::string> words;
    std::string sentence;
  };
  const std::vector<Bad> cases = {
      {"run", {"--steps", "5"}, "--steps: bench run does not take this option, but --frames"},
      {"run", {"--duration", "1"}, "--duration: bench run does not take this option, but --frames"},
      {"run",
       {"--frames", "3", "--times", "5"},
       "--times: expected times within the 3 frames of 1/60 s that --frames says, got 5.0 s"},
      {"run", {"--times", "0.5,0.25"}, "--times: expected ascending times, got 0.25 after 0.5"},
      {"reference", {"--times", "1", "--steps", "5"}, "--steps: expected either this or --times"},
      {"reference", {"--times", "1e9"}, "--times: expected at most 1e9 steps of the scene, got 5"},
      {"reference",
       {"--kind", "rigid_chain", "--step", "0.1"},
       "--step: rigid_chain has no method"},
      {"reference",
       {"--kind", "closed_form", "--step", "0.1"},
       "--step: closed_form has no method"},
      {"reference", {"--kind", "best"}, "--kind: expected run, rigid_chain or closed_form"},
  };
  for (const Bad& bad : cases) {
    std::vector<std::string> words{"bench", bad.kind, scene.file};
    words.insert(words.end(), bad.words.begin(), bad.words.end());
    const Ending ending = pleat_command(scene.folder, words);
    CAPTURE(ending.error);
    CHECK(ending.status == 2);
    CHECK(ending.error.rfind("pleat: " + bad.sentence, 0) == 0);
  }
}
