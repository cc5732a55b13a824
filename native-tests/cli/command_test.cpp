#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/measure/bench_row.h"
#include "core/scene/frame_file.h"
#include "core/scene/json_text.h"
#include "core/scene/matrix_file.h"

using namespace pleat;
namespace fs = std::filesystem;

namespace {

/// A folder of the test's own, gone with it. Its name has a space, as folders of users have.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / "pleat test XXXXXX") {
    std::string name = path_.string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

struct Ending {
  int status;
  std::string out;
  std::string error;
};

/// Runs the command with these words.
Ending pleat_command(const Folder& folder, const std::vector<std::string>& words) {
  std::string line = "'" PLEAT_COMMAND "'";
  for (const std::string& word : words) line += " '" + word + "'";
  line += " >'" + (folder / "stdout").string() + "' 2>'" + (folder / "stderr").string() + "'";
  const int status = std::system(line.c_str());
  return {WEXITSTATUS(status), text_of(folder / "stdout"), text_of(folder / "stderr")};
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

/// A folder with that scene in it.
struct SmallScene {
  Folder folder;
  std::string file = (folder / "scene.json").string();
  SmallScene() { write(file, kScene); }

  Ending run(std::vector<std::string> words) const {
    words.insert(words.begin() + 1, file);
    return pleat_command(folder, words);
  }
};

}  // namespace

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
  const std::string out = (scene.folder / "rows.jsonl").string();
  const Ending ending =
      scene.run({"sweep", "--json", "--levels", "0,1", "--steppers", "implicit,projective",
                 "--repeat", "1", "--out", out, "--cache", (scene.folder / "cache").string()});
  CHECK(ending.error.empty());
  REQUIRE(ending.status == 0);
  CHECK(text_of(out) == ending.out);
  std::size_t n_rows = 0;
  std::size_t begin = 0;
  while (begin < ending.out.size()) {
    const std::size_t end = ending.out.find('\n', begin);
    const BenchRow row = read_bench_row(ending.out.substr(begin, end - begin));
    CHECK(row.position_error > 0);
    CHECK(row.target == "native");
    begin = end + 1;
    ++n_rows;
  }
  CHECK(n_rows == 8);
  CHECK(std::distance(fs::directory_iterator(scene.folder / "cache"), {}) == 1);
  const Ending table = scene.run({"sweep", "--steppers", "implicit", "--repeat", "1"});
  CHECK(table.out.find("| front |") != std::string::npos);
  CHECK(table.out.find("not converged") != std::string::npos);
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
      {{"run", "--stepper", "explicit"}, "scene.json: /method/substeps: "},
      {{"sweep", "--levels", "0,x"}, "--levels: "},
      {{"sweep", "--levels", "0,,1"}, "--levels: "},
      {{"sweep", "--steppers", "magic"}, "--steppers: "},
      {{"sweep", "--reference", "none"}, "--reference: "},
      {{"sweep", "--repeat", "0"}, "--repeat: "},
      {{"bench"}, "scene.json: "},
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
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    return text.replace(text.find(from), from.size(), to);
  };
  const std::vector<Bad> cases = {
      {whole.substr(0, whole.size() / 2), "line 5"},
      {"", "line 1"},
      {replaced("\"rows\": 2", "\"rows\": 0"), "/cloth/sheet/rows"},
      {replaced("\"rows\": 2", "\"rows\": \"two\""), "/cloth/sheet/rows"},
      {replaced("\"step_s\": 0.02", "\"step_s\": NaN"), "line 6"},
      {replaced("\"step_s\": 0.02", "\"step_s\": 0"), "/method/step_s"},
      {replaced("\"pins\"", "\"pinz\""), "/pinz"},
  };
  for (const Bad& bad : cases) {
    const Folder folder;
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

// Drag grows with the square of the speed, which the explicit method's stability bound does not
// cover: in dense enough air each step throws the triangle back faster than it came.
TEST_CASE("command: a run that diverges stops, says where, and keeps the last finite frame",
          "[cli]") {
  const Folder folder;
  write(folder / "wild.json", R"({
    "cloth": {"particles": {
      "positions_m": [[0, 0, 0], [1, 0, 0], [0, 0, 1]],
      "velocities_m_per_s": [[0, 1, 0], [0, 1, 0], [0, 1, 0]],
      "masses_kg": [0.1, 0.1, 0.1],
      "springs": [{"a": 0, "b": 1, "stiffness_n_per_m": 1}],
      "triangles": [[0, 1, 2]]}},
    "method": {"stepper": "explicit", "step_s": 0.01, "substeps": 1},
    "world": {"air": {"density_kg_per_m3": 10000}},
    "duration_s": 1,
    "record": {"every_s": 0.01, "format": "binary"}
  })");
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
  const Folder folder;
  CHECK(pleat_command(folder, {"help"}).status == 0);
  CHECK(pleat_command(folder, {"run", "--help"}).out == pleat_command(folder, {"--help"}).out);
  CHECK(pleat_command(folder, {"--version"}).out.rfind("pleat core-", 0) == 0);
  CHECK(pleat_command(folder, {}).status == 0);
  CHECK(pleat_command(folder, {"frob"}).status == 2);
  CHECK(pleat_command(folder, {"run"}).status == 2);
  CHECK(pleat_command(folder, {"run", "/nowhere.json"}).status == 2);
}
