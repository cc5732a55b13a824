#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/files/json_text.h"
#include "core/reference/reference.h"
#include "core/sweep/bench_row.h"
#include "native-tests/support/small_scene.h"

using namespace pleat;
namespace fs = std::filesystem;

namespace {

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

/// Each file below a folder and when it was written.
std::map<std::string, fs::file_time_type> dates_in(const fs::path& folder) {
  std::map<std::string, fs::file_time_type> dates;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    dates[entry.path().string()] = fs::last_write_time(entry.path());
  return dates;
}

}  // namespace

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
  CHECK(files.size() == 3);                       // both levels, and a finer one
  CHECK(sizes == std::set<Eigen::Index>{9, 25});  // the finer one has the vertices of level 1 alone
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
  CHECK(run(std::string(R"({"grid": {"/refinement/level": [0]}, "scene": )") + kSmallScene + "}")
            .status == 0);

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
  CHECK(references.size() <= 15);  // five fabrics at three levels
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
  // Another core's plan, and files whose plan is lost.
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
