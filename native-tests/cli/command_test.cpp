#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/files/json_text.h"
#include "core/reference/reference.h"
#include "core/sweep/bench_row.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/matrix_market.h"
#include "native-tests/support/pleat_command.h"
#include "native-tests/support/recorded_frames.h"

using namespace pleat;
namespace fs = std::filesystem;

namespace {

/// Every file below a folder and what is in it.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> texts;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) texts[entry.path().string()] = text_of(entry.path());
  return texts;
}

constexpr const char* kScene = R"({
  "name": "small sheet",
  "cloth": {"sheet": {"columns": 2, "rows": 2, "warp_direction": [0, 0, 1]}},
  "fabric": {"name": "fine cotton"},
  "pins": [{"part": "upper_edge"}],
  "method": {"step_s": 0.02, "solver": "eigen"},
  "record": {"every_s": 0.04, "format": "binary"},
  "duration_s": 0.2
})";

// Drag grows with the square of the speed, which the explicit method's stability bound does not
// cover: in dense enough air each step throws the triangle back faster than it came.
constexpr const char* kWildScene = R"({
  "cloth": {"particles": {
    "positions_m": [[0, 0, 0], [1, 0, 0], [0, 0, 1]],
    "velocities_m_per_s": [[0, 1, 0], [0, 1, 0], [0, 1, 0]],
    "masses_kg": [0.1, 0.1, 0.1],
    "springs": [{"a": 0, "b": 1, "stiffness_n_per_m": 1}],
    "triangles": [[0, 1, 2]]}},
  "method": {"stepper": "explicit", "step_s": 0.016666666666666666, "substeps": 1},
  "world": {"air": {"density_kg_per_m3": 10000}},
  "duration_s": 1,
  "record": {"every_s": 0.01, "format": "binary"}
})";

/// The scene with a part of its text replaced.
std::string scene_with(const std::string& from, const std::string& to) {
  std::string text = kScene;
  return text.replace(text.find(from), from.size(), to);
}

/// A folder with a scene in it.
struct SmallScene {
  ScratchFolder folder;
  std::string file = (folder / "scene.json").string();
  explicit SmallScene(const std::string& text = kScene) { write(file, text); }

  Ending run(std::vector<std::string> words) const {
    words.insert(words.begin() + 1, file);
    return pleat_command(folder, words);
  }
};

/// The rows of JSON lines.
std::vector<BenchRow> rows_in(const std::string& lines) {
  std::vector<BenchRow> rows;
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = lines.find('\n', begin);
    const Json row = parse_json(lines.substr(begin, end - begin));
    rows.push_back(read_bench_row(JsonReader(row)));
    begin = end + 1;
  }
  return rows;
}

/// Thirty points and two timed rounds, in a folder.
struct SweepOfThirty {
  SmallScene scene;
  std::string out;
  std::string journal = out + "/runs.jsonl";

  explicit SweepOfThirty(const std::string& name) : out((scene.folder / name).string()) {}

  Ending run(const std::string& before = "", const std::string& after = "") const {
    return pleat_command(scene.folder,
                         {"sweep", scene.file, "--steppers", "implicit", "--levels", "0,1,2",
                          "--set", "/fabric/name=silk,wool,linen,canvas,poplin", "--duration",
                          "0.1", "--repeat", "2", "--reference", "same_mesh", "--out", out},
                         before, after);
  }
};

std::ptrdiff_t n_lines(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

/// Each file below a folder and when it was written.
std::map<std::string, fs::file_time_type> dates_in(const fs::path& folder) {
  std::map<std::string, fs::file_time_type> dates;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    dates[entry.path().string()] = fs::last_write_time(entry.path());
  return dates;
}

}  // namespace

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

TEST_CASE("command: sweep prints rows that all name their reference", "[cli]") {
  const SmallScene scene;
  const std::string out = (scene.folder / "a/sweep").string();
  const Ending ending = scene.run(
      {"sweep", "--json", "--levels", "0,1", "--steppers", "implicit,projective", "--repeat", "1",
       "--reference", "same_mesh", "--out", out, "--cache", (scene.folder / "cache").string()});
  CHECK(ending.error.empty());
  REQUIRE(ending.status == 0);
  CHECK(text_of(out + "/rows.jsonl") == ending.out);
  const std::vector<BenchRow> rows = rows_in(ending.out);
  CHECK(rows.size() == 8);
  for (const BenchRow& row : rows) {
    CHECK(row.position_error > 0);
    CHECK(row.target == "native");
  }
  CHECK(std::distance(fs::directory_iterator(scene.folder / "cache"), {}) == 2);
  CHECK_FALSE(fs::exists(out + "/references"));
  CHECK(text_of(out + "/front.svg").rfind("<svg ", 0) == 0);
  const Ending table = scene.run({"sweep", "--steppers", "implicit", "--repeat", "1"});
  CHECK(table.out.find("| front |") != std::string::npos);
  CHECK(table.out.find("halving its step changed it by") != std::string::npos);
}

TEST_CASE("command: the references of a sweep are made alone, and found by another one", "[cli]") {
  const SmallScene scene;
  const std::string shipped = (scene.folder / "shipped").string();
  const auto sweep = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"sweep", "--levels", "0,1", "--steppers", "implicit"});
    return scene.run(words);
  };
  const Ending made = sweep({"--ship-references", shipped, "--keep-level", "1"});
  REQUIRE(made.status == 0);
  std::set<Eigen::Index> sizes;
  std::map<std::string, std::string> files = contents(shipped);
  for (const auto& [path, bytes] : files) {
    const Reference reference = read_reference(bytes);
    CHECK(fs::path(path).filename() == reference.label.id + ".reference");
    CHECK(made.out.find(reference.label.id + ": newton") != std::string::npos);
    sizes.insert(reference.samples.at(0).positions.cols());
  }
  CHECK(files.size() == 3);                       // of both levels, and a finer one
  CHECK(sizes == std::set<Eigen::Index>{9, 25});  // which has the vertices of level 1 alone
  const Ending again = sweep({"--ship-references", shipped});
  CHECK(again.status == 2);
  CHECK(again.error.find("--overwrite") != std::string::npos);
  CHECK(contents(shipped) == files);
  const Ending measured = sweep({"--json", "--repeat", "1", "--cache", shipped});
  REQUIRE(measured.status == 0);
  CHECK(contents(shipped) == files);
  for (const BenchRow& row : rows_in(measured.out)) {
    CHECK(row.reference.id.rfind("converged-", 0) == 0);
    CHECK(row.method_error > 0);
  }
}

TEST_CASE("command: a sweep none of whose errors is known says so, and exit status 1", "[cli]") {
  const SmallScene scene;
  // A reference whose step is coarser than what it judges.
  const Json method = {{"stepper", "newton"}, {"rule", "midpoint"}, {"step_s", 0.001}};
  const Json plan = {{"scene", fs::path(scene.file).filename().string()},
                     {"settings", Json::array({{{"/method", method}}})},
                     {"repeats", 1},
                     {"reference", "same_mesh"},
                     {"reference_step_s", 0.01}};
  write(scene.folder / "plan.json", plan.dump());
  const Ending ending =
      pleat_command(scene.folder, {"sweep", (scene.folder / "plan.json").string()});
  CAPTURE(ending.out);
  CHECK(ending.status == 1);
  CHECK(ending.error.find("not known well enough") != std::string::npos);
}

TEST_CASE("command: --set sweeps any value of the scene, alone or with steppers", "[cli]") {
  const SmallScene scene;
  const auto settings = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"sweep", "--json", "--repeat", "1"});
    const Ending ending = scene.run(words);
    CAPTURE(words, ending.error);
    REQUIRE(ending.status == 0);
    std::vector<Json> changes;
    for (const BenchRow& row : rows_in(ending.out)) changes.push_back(row.setting);
    return changes;
  };
  const auto grid =
      settings({"--set", "/fabric/name=silk,fine cotton", "--set", "/method/substeps=1,2"});
  REQUIRE(grid.size() == 4);
  CHECK(grid[1] == Json{{"/fabric/name", "silk"}, {"/method/substeps", 2}});
  CHECK(grid[2] == Json{{"/fabric/name", "fine cotton"}, {"/method/substeps", 1}});
  const auto vectors = settings({"--set", "/world/gravity_m_per_s2=[0,-9,0],[0,-1,0]"});
  REQUIRE(vectors.size() == 2);
  CHECK(vectors[1].at("/world/gravity_m_per_s2") == Json{0, -1, 0});
  const auto both = settings({"--set", "/model/shear=true,false", "--steppers", "implicit"});
  REQUIRE(both.size() == 4);
  CHECK(both[3].at("/model/shear") == false);
  CHECK(both[3].at("/method").at("substeps") == 4);
}

TEST_CASE("command: a plan's file says which settings to run, and on which scene", "[cli]") {
  const SmallScene scene;
  const std::string plan = (scene.folder / "plan.json").string();
  const auto run = [&](const std::string& text, std::vector<std::string> words = {}) {
    write(plan, text);
    words.insert(words.begin(), {"sweep", plan, "--json"});
    return pleat_command(scene.folder, words);
  };
  const Ending named =
      run(R"({"scene": "scene.json", "settings": [{"/method/substeps": 3}, {}], "repeats": 1})");
  CAPTURE(named.error);
  REQUIRE(named.status == 0);
  const std::vector<BenchRow> rows = rows_in(named.out);
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].n_substeps == 3);
  CHECK(rows[1].n_substeps == 1);
  CHECK(rows[1].n_runs == 1);
  CHECK(
      run(std::string(R"({"grid": {"/refinement/level": [0]}, "scene": )") + kScene + "}").status ==
      0);

  struct Bad {
    std::string text;
    std::vector<std::string> words;
    std::string sentence;
  };
  const std::vector<Bad> cases = {
      {R"({"scene": "scene.json", "grid": {"/refinement/level": [9]}})",
       {},
       "plan.json: /grid/~1refinement~1level/0: in the scene, /refinement/level: expected "},
      {R"({"scene": "scene.json", "repeat": 3})", {}, "plan.json: /repeat: expected the key "},
      {R"({"scene": "none.json"})", {}, "none.json: expected a file, "},
      {R"({"scene": "plan.json"})", {}, "plan.json: /scene: expected "},
      {R"({"scene": {}})", {}, "plan.json: /scene: expected the key \"cloth\""},
      {R"({"scene": "scene.json", "reference": "rigid_chain",
           "settings": [{"/pins": []}]})",
       {},
       "scene.json: /pins: expected the whole upper edge held"},
      {R"({"scene": "scene.json"})", {"--levels", "1"}, "--levels: a plan's file says this"},
      {R"({"scene": "scene.json"})", {"--fabric", "silk"}, "--fabric: a plan's file says this"},
  };
  for (const Bad& bad : cases) {
    const Ending ending = run(bad.text, bad.words);
    CAPTURE(bad.text, ending.error);
    CHECK(ending.status == 2);
    CHECK(ending.error.find(bad.sentence) != std::string::npos);
  }
}

TEST_CASE("command: a sweep killed anywhere goes on and loses no row", "[cli]") {
  const SweepOfThirty sweep("out");
  const std::string way = GENERATE(as<std::string>(), "first round", "timed round", "from outside");
  CAPTURE(way);
  if (way == "from outside") {
    sweep.run("", " & victim=$!; until [ \"$(wc -l <'" + sweep.journal +
                      "')\" -ge 15 ]; do sleep 0.002; done 2>&-; kill -KILL $victim");
  } else {
    // More bytes in one file than the limit kill: here in a line of the journal, the largest.
    const SweepOfThirty whole("whole");
    REQUIRE(whole.run().status == 0);
    const auto n_rows = fs::file_size(whole.out + "/rows.jsonl");
    const auto n_journal = fs::file_size(whole.journal);
    const auto limit = way == "first round" ? n_rows * 9 / 10 : (n_rows + n_journal) / 2;
    const std::string blocks = std::to_string(limit / 512);
    CHECK(sweep.run("ulimit -c 0; ulimit -f " + blocks + "; ").status != 0);
  }

  const std::string before = text_of(sweep.journal);
  const std::string kept = before.substr(0, before.rfind('\n') + 1);
  CHECK(n_lines(kept) >= 10);
  if (way == "first round") CHECK(n_lines(kept) < 30);
  if (way == "timed round") CHECK((n_lines(kept) > 30 && n_lines(kept) < 90));
  const auto references = dates_in(sweep.out + "/references");
  CHECK(references.size() <= 15);  // of five fabrics at three levels
  CHECK(references.size() >= 5);

  const Ending ending = sweep.run();
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  const std::string after = text_of(sweep.journal);
  CHECK(after.rfind(kept, 0) == 0);
  CHECK(n_lines(after) == 90);
  std::set<std::string> settings;
  for (const BenchRow& row : rows_in(text_of(sweep.out + "/rows.jsonl"))) {
    CHECK(row.n_runs == 2);
    CHECK(settings.insert(row.setting.dump()).second);
  }
  CHECK(settings.size() == 30);
  for (const auto& [file, date] : dates_in(sweep.out + "/references"))
    CHECK((references.count(file) == 0 || references.at(file) == date));
  REQUIRE(sweep.run().status == 0);  // nothing is left to do
  CHECK(text_of(sweep.journal) == after);
}

TEST_CASE("command: a folder of another sweep is refused or replaced", "[cli]") {
  const SmallScene scene;
  const std::string out = (scene.folder / "out").string();
  const auto sweep = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"sweep", "--steppers", "implicit", "--repeat", "1", "--out", out});
    return scene.run(words);
  };
  REQUIRE(sweep({}).status == 0);
  const auto before = contents(out);
  const Ending other = sweep({"--duration", "0.3"});
  CHECK(other.status == 2);
  CHECK(other.error.find("/out: expected a folder without another sweep's files, got runs.jsonl "
                         "of another plan; --overwrite removes them\n") != std::string::npos);
  CHECK(sweep({"--commit", "changed"}).status == 2);
  CHECK(contents(out) == before);
  write(out + "/notes.txt", "mine");
  REQUIRE(sweep({"--duration", "0.3", "--overwrite"}).status == 0);
  CHECK(text_of(out + "/notes.txt") == "mine");
  CHECK(rows_in(text_of(out + "/rows.jsonl")).size() == 2);
  // The same plan by another core, and files whose plan is lost.
  std::string plan = text_of(out + "/plan.json");
  write(out + "/plan.json", plan.replace(plan.find("core-"), 9, "core-0123"));
  CHECK(sweep({"--duration", "0.3"}).error.find(" of another core; ") != std::string::npos);
  fs::remove(out + "/plan.json");
  CHECK(sweep({"--duration", "0.3"}).status == 2);
  REQUIRE(sweep({"--duration", "0.3", "--overwrite"}).status == 0);
  // The journal that a kill in the middle of a line leaves.
  const std::string journal = text_of(out + "/runs.jsonl");
  write(out + "/runs.jsonl", journal.substr(0, journal.size() - 3));
  REQUIRE(sweep({"--duration", "0.3"}).status == 0);
  CHECK(rows_in(text_of(out + "/rows.jsonl")).size() == 2);
  CHECK(text_of(out + "/runs.jsonl")
            .rfind(journal.substr(0, journal.rfind('\n', journal.size() - 2)), 0) == 0);
}

TEST_CASE("command: bad input is one sentence that names the place, and exit status 2", "[cli]") {
  struct Bad {
    std::vector<std::string> words;  // after the scene's file
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
      {{"run", "--xyzzy", "3"}, "--xyzzy: unknown option; \"pleat help\""},
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
       "pleat: bench: expected run, reference, deform, plans, together, rows or limit after it, "
       "got "},
      {{"run", "--out", std::string(300, 'x')}, "xxx: expected a folder that can be read, got "},
      {{"run", "--overwrite"}, "pleat: --overwrite: expected --out "},
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
    CHECK(std::count(ending.error.begin(), ending.error.end(), '\n') == 1);
  }
}

TEST_CASE("command: a bad scene is told with its file and place, and nothing is written", "[cli]") {
  struct Bad {
    std::string text;
    std::string place;
  };
  const std::string whole = kScene;
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
    CHECK(std::count(ending.error.begin(), ending.error.end(), '\n') == 1);
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
    CHECK(std::count(ending.error.begin(), ending.error.end(), '\n') == 1);
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
  CHECK(pleat_command(folder, {"run", "--help"}).out == pleat_command(folder, {"--help"}).out);
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
  CHECK(std::count(ending.error.begin(), ending.error.end(), '\n') == 1);
  const SmallScene named(scene_with("small sheet", "\\u001b[31mred"));
  CHECK(named.run({"run"}).out.rfind("\\u001b[31mred: ", 0) == 0);
}

TEST_CASE("command: bad input leaves folders that exist as they were", "[cli]") {
  struct Bad {
    std::string text;
    std::vector<std::string> words;  // after the folders' own
  };
  const std::vector<Bad> cases = {
      {scene_with("\"step_s\": 0.02", "\"step_s\": 0"), {}},
      {scene_with("\"solver\": \"eigen\"", "\"stepper\": \"explicit\", \"substeps\": 1"),
       {"--overwrite"}},
      {kScene, {}},  // the folder holds an earlier run
      {kScene, {"--overwrite", "--level", "99"}},
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
}

TEST_CASE("command: --stepper takes any scene, with defaults for what it cannot take", "[cli]") {
  const std::string method = "\"step_s\": 0.02, \"solver\": \"eigen\"";
  const SmallScene cg(scene_with(method, "\"solver\": \"cg\", \"substeps\": 3"));
  const SmallScene stable(
      scene_with(method, "\"stepper\": \"explicit\", \"substeps\": \"stable\""));
  const auto substeps = [](const SmallScene& scene, const std::string& stepper) {
    const Ending ending = scene.run({"run", "--json", "--steps", "1", "--stepper", stepper});
    CAPTURE(stepper, ending.error);
    REQUIRE(ending.status == 0);
    return parse_json(ending.out).at("n_substeps").get<int>();
  };
  CHECK(substeps(cg, "projective") == 3);
  CHECK(substeps(cg, "xpbd") == 3);
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

// A spring so stiff that the masses at its ends are lost in rounding: no direct solver takes it.
TEST_CASE("command: a sweep without a reference says so, and exit status 1", "[cli]") {
  const ScratchFolder folder;
  write(folder / "stiff.json", R"({
    "cloth": {"particles": {"positions_m": [[0, 0, 0], [1, 0, 0]], "masses_kg": [1e-12, 1e-12],
              "springs": [{"a": 0, "b": 1, "stiffness_n_per_m": 1e12}]}},
    "world": {"gravity_m_per_s2": [0, 0, 0]},
    "duration_s": 0.1
  })");
  const Ending ending = pleat_command(
      folder, {"sweep", (folder / "stiff.json").string(), "--steppers", "xpbd", "--repeat", "1"});
  CAPTURE(ending.out);
  CHECK(ending.status == 1);
  CHECK(ending.out.find("| ok |") != std::string::npos);
  CHECK(ending.error.find("could not be solved") != std::string::npos);
}

#ifndef __SANITIZE_ADDRESS__  // which needs terabytes of address space itself
TEST_CASE("command: too little memory is told with the number of vertices", "[cli]") {
  const SmallScene scene(
      scene_with("\"columns\": 2, \"rows\": 2", "\"columns\": 999, \"rows\": 999"));
  const Ending ending = pleat_command(scene.folder, {"run", scene.file}, "ulimit -v 200000; ");
  CAPTURE(ending.error);
  CHECK(ending.status == 2);
  CHECK(ending.error.find("scene.json: not enough memory for 1000000 vertices") !=
        std::string::npos);
  write(scene.file, "[" + std::string(150'000'000, ' '));
  const Ending text = pleat_command(scene.folder, {"run", scene.file}, "ulimit -v 200000; ");
  CAPTURE(text.error);
  CHECK(text.status == 2);
  CHECK(text.error.find("scene.json: not enough memory to read it") != std::string::npos);
}
#endif

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

TEST_CASE("command: refine refuses an example, a plan or an option that it cannot use", "[cli]") {
  const SmallScene scene;
  write(scene.folder / "other.json", scene_with("\"columns\": 2", "\"columns\": 3"));
  write(scene.folder / "particles.json",
        R"({"cloth": {"particles": {"positions_m": [[0, 0, 0]], "masses_kg": [1]}}})");
  Json wild = parse_json(kScene);
  wild["cloth"]["sheet"]["initial_velocity_m_per_s"] = {0, 30, 0};
  wild["method"] = {{"stepper", "explicit"}, {"substeps", "stable"}};
  wild["world"]["air"]["density_kg_per_m3"] = 1e5;
  write(scene.folder / "wild.json", wild.dump());
  write(scene.folder / "still.json",
        scene_with("\"record\"", "\"world\": {\"gravity_m_per_s2\": [0, 0, 0]}, \"record\""));
  const auto other = [&](const char* file) { return (scene.folder / file).string(); };
  const struct {
    std::vector<std::string> words;
    std::string sentence;
  } cases[] = {
      {{scene.file, "--demand", "8"}, "--demand: expected a number from 0 to below 8, got 8"},
      {{scene.file, "--demand", "-1"}, "--demand: expected a number >= 0, got \"-1\""},
      {{scene.file, "--vertices", "8"}, "--vertices: expected at least the base mesh's 9, got 8"},
      {{scene.file, "--cap", "3"},
       "--cap: expected a whole number from 0 to the fine mesh's level, 2, got 3"},
      {{scene.file, "--patterns", "17"}, "--patterns: expected a whole number from 1 to 16"},
      {{other("still.json")}, "--patterns: expected at most the number of different features"},
      {{scene.file, "--from", "0.19"},
       scene.file + ": /duration_s: expected at least two frames after 0.19 s, got 1"},
      {{scene.file, "--level", "0"}, "--level: expected an example refined once at least"},
      {{scene.file, "--merge", other("other.json")},
       other("other.json") +
           ": /cloth: expected examples of one cloth at one level, got \"small sheet\" at "
           "level 2 with 12 unrefined vertices beside \"small sheet\" at level 2 with 9 "},
      {{other("particles.json")}, other("particles.json") + ": /cloth: expected a sheet or"},
      {{other("wild.json")}, other("wild.json") + ": expected an example that runs to its end"},
  };
  for (const auto& bad : cases) {
    std::vector<std::string> words{"refine"};
    words.insert(words.end(), bad.words.begin(), bad.words.end());
    const Ending ending = pleat_command(scene.folder, words);
    CAPTURE(bad.sentence, ending.error);
    CHECK(ending.status == 2);
    CHECK(ending.error.rfind("pleat: " + bad.sentence, 0) == 0);
    CHECK(std::count(ending.error.begin(), ending.error.end(), '\n') == 1);
  }
}

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
    CHECK(std::count(ending.error.begin(), ending.error.end(), '\n') == 1);
  };
  Json planned = parse_json(kScene);
  planned["refinement"] = {{"plan", "plan.json"}};
  planned["cloth"]["sheet"]["columns"] = 3;
  is_refused(planned.dump(), "plan.json: /base_mesh: expected a plan for this mesh, got one for");
  planned["cloth"]["sheet"]["columns"] = 2;
  Json bad = plan;
  bad["detail_demand"] = 8;
  write(plan_file, bad.dump());
  is_refused(planned.dump(), "plan.json: /detail_demand: expected a number below 8, got 8");
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

TEST_CASE("command: a reference is kept with how well it is known", "[cli]") {
  const SmallScene scene;
  const std::string out = (scene.folder / "small.reference").string();
  const Ending ending =
      scene.run({"reference", "--step", "0.004", "--every", "0.04", "--out", out});
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  CHECK(ending.out.find("halving its step changed it by") != std::string::npos);
  const Reference reference = read_reference(text_of(out));
  REQUIRE(reference.samples.size() == 5);
  CHECK(reference.samples[4].time == Approx(0.2));
  CHECK(reference.samples[4].uncertainty > 0);
  CHECK(reference.label.id.rfind("same-mesh-", 0) == 0);
  const Ending other =
      scene.run({"reference", "--step", "0.004", "--kind", "converged", "--level", "1"});
  CHECK(other.status == 0);
  CHECK(other.out.find("halving its mesh changed it by") != std::string::npos);
}

TEST_CASE("command: a reference refuses what it would not use or could not keep", "[cli]") {
  const SmallScene scene;
  struct Bad {
    std::vector<std::string> words;
    std::string place;
  };
  const std::vector<Bad> cases = {{{"reference", "--stepper", "xpbd"}, "--stepper: "},
                                  {{"reference", "--substeps", "2"}, "--substeps: "},
                                  {{"reference", "--kind", "best"}, "--kind: "},
                                  {{"reference", "--every", "0"}, "--every: "},
                                  {{"reference", "--every", "1"}, "--every: "},
                                  {{"reference", "--out", "."}, "."},
                                  {{"reference", "--step", "0"}, "--step: "}};
  for (const Bad& bad : cases) {
    const Ending ending = scene.run(bad.words);
    CAPTURE(bad.words.back(), ending.error);
    CHECK(ending.status == 2);
    CHECK(ending.error.find(bad.place) != std::string::npos);
    CHECK(n_lines(ending.error) == 1);
  }
}
