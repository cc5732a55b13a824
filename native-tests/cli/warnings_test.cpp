#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/files/json_text.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/pleat_command.h"

namespace pleat {
namespace {

/// A folder with the curtain, drawn by one substep of xpbd where too few are asked for.
struct Curtain {
  ScratchFolder folder;
  std::string file = (folder / "curtain.json").string();

  Curtain() {
    Json json = parse_json(scene_text("curtain"));
    json["method"] = {{"stepper", "xpbd"}, {"substeps", 1}};
    json["refinement"]["level"] = 1;
    json["duration_s"] = 0.5;
    write(file, json.dump());
  }

  Ending call(std::vector<std::string> words) const {
    words.insert(words.begin() + 1, file);
    return pleat_command(folder, words);
  }
};

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("warnings: a run that shows nonsense is told, and exit status 1 with --check", "[cli]") {
  const Curtain curtain;
  for (const bool checks : {false, true}) {
    CAPTURE(checks);
    std::vector<std::string> words = {"run", "--json"};
    if (checks) words.emplace_back("--check");
    const Ending ending = curtain.call(words);
    CHECK(ending.status == (checks ? 1 : 0));
    CHECK(holds(ending.error, "pleat: warning: from "));
    CHECK(holds(ending.error, "; try /method/substeps = 30 or /method = {"));
    const Json metrics = parse_json(ending.out);
    CHECK(metrics.at("status") == "ok");
    CHECK(metrics.at("warnings").at(0).at("kind") == "stretch");
  }
  const Ending well = curtain.call({"run", "--json", "--check", "--stepper", "implicit"});
  CHECK(well.status == 0);
  CHECK(parse_json(well.out).at("warnings").empty());
}

TEST_CASE("warnings: what a solver left goes on, and is a failure only with --check", "[cli]") {
  const Curtain curtain;
  const std::string wrinkles = repository_path("assets/deform/wrinkles.json");
  // A pull goes one vertex far in a sweep of sor, and a third of so stiff a chain in all of them;
  // then a factor solves.
  Json chain = parse_json(R"({"pins": [{"vertices": [0]}], "duration_s": 1})");
  Json& particles = chain["cloth"]["particles"];
  for (int i = 0; i < 300; ++i) {
    particles["positions_m"].push_back({0, -0.1 * i, 0});
    particles["masses_kg"].push_back(0.01);
    if (i > 0) particles["springs"].push_back({{"a", i - 1}, {"b", i}, {"stiffness_n_per_m", 1e6}});
  }
  const std::string file = (curtain.folder / "chain.json").string();
  write(file, chain.dump());
  const std::pair<std::vector<std::string>, const char*> calls[] = {
      {{"run", file, "--stepper", "implicit", "--solver", "sor", "--steps", "2", "--json"}, "ok"},
      {{"deform", wrinkles, "--form", "published", "--fabric", "wool", "--json"}, "not_converged"}};
  for (auto [words, told] : calls) {
    CAPTURE(words);
    for (const int status : {0, 1}) {
      if (status == 1) words.emplace_back("--check");
      const Ending ending = pleat_command(curtain.folder, words);
      CHECK(ending.status == status);
      CHECK(parse_json(ending.out).at("status") == told);
      CHECK(ending.error.rfind("pleat: warning: ", 0) == 0);
    }
  }
}

TEST_CASE("warnings: a row of a sweep is told, marked and on no front", "[cli]") {
  const Curtain curtain;
  const std::string out = (curtain.folder / "sweep").string();
  const Ending ending = curtain.call({"sweep", "--set", "/method/substeps=1,60", "--levels", "1",
                                      "--repeat", "1", "--reference", "same_mesh", "--out", out});
  CAPTURE(ending.error, ending.out);
  CHECK(ending.status == 0);
  CHECK(holds(ending.error, "pleat: warning: xpbd, "));
  CHECK(holds(ending.out, "| ! | xpbd, 1/60 s x 1 |"));
  CHECK(holds(ending.out, "| * | xpbd, 1/60 s x 60 |"));
  CHECK(holds(ending.out, "!: the run shows what its scene cannot explain"));
  const std::string rows = text_of(out + "/rows.jsonl");
  const Json first = parse_json(rows.substr(0, rows.find('\n')));
  CHECK(first.at("warnings").at(0).at("kind") == "stretch");
}

TEST_CASE("warnings: an example that a plan is made of is told", "[cli]") {
  const Curtain curtain;
  const Ending ending = curtain.call({"refine", "--level", "1"});
  CHECK(ending.status == 0);
  CHECK(holds(ending.error, "pleat: warning: example \"curtain\": from "));
  const Ending well = curtain.call({"refine", "--level", "1", "--stepper", "implicit"});
  CHECK_FALSE(holds(well.error, "warning"));
}

}  // namespace pleat
