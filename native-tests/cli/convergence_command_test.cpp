#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "core/files/json_text.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/small_scene.h"

namespace pleat {
namespace {

/// A folder with a sheet of 9 x 9 vertices that is let go, and a method.
struct StepFolder {
  ScratchFolder folder;
  std::string scene = (folder / "scene.json").string();
  std::string method = (folder / "method.json").string();

  StepFolder() {
    write(
        scene,
        R"({"name": "sheet", "cloth": {"sheet": {"width_m": 1, "height_m": 1, "columns": 8, "rows": 8,
            "warp_direction": [0, -1, 0], "weft_direction": [1, 0, 0]}},
            "fabric": {"name": "fine cotton"}, "pins": [{"part": "upper_edge"}], "duration_s": 1})");
    write(method, R"({"stepper": "pbd", "smoother": "sor", "omega": 1.5})");
  }
  Ending run(std::vector<std::string> words) const {
    words.insert(words.begin(), "convergence");
    return pleat_command(folder, words);
  }
};

}  // namespace

TEST_CASE("convergence command: a series for each method, from the same error", "[cli]") {
  const StepFolder place;
  const Ending ending =
      place.run({place.scene, "--methods", "pbd,multigrid," + place.method, "--rounds", "17",
                 "--at", "0.05", "--constraints", "compliant", "--json"});
  CAPTURE(ending.error);
  REQUIRE(ending.status == 0);
  const Json study = parse_json(ending.out);
  CHECK(study.at("n_vertices") == 81);
  CHECK(study.at("time_s").get<double>() == Approx(0.05));
  REQUIRE(study.at("series").size() == 3);
  for (const Json& series : study.at("series")) {
    CHECK(series.at("distance_begin_m") == study.at("series")[0].at("distance_begin_m"));
    int last = 0;
    for (const Json& point : series.at("points")) {
      CHECK(point.at("rounds") > last);
      CHECK(point.at("ms") > 0);
      last = point.at("rounds");
    }
  }
  CHECK(study.at("series")[2].at("method").at("omega") == 1.5);
  // One of a quad's diagonals is left: 9 8 2 edges and 64 diagonals.
  CHECK(study.at("n_springs") == 208);
}

TEST_CASE("convergence command: bad input is one sentence", "[cli]") {
  const StepFolder place;
  const auto fails = [&](const std::vector<std::string>& words, const std::string& sentence) {
    const Ending ending = place.run(words);
    CAPTURE(sentence, ending.error);
    CHECK(ending.status == 2);
    CHECK(ending.error.find(sentence) != std::string::npos);
    CHECK(std::count(ending.error.begin(), ending.error.end(), '\n') == 1);
  };
  fails({}, "a scene file");
  fails({place.scene, "--methods", "jacobi"}, "--methods: expected steppers");
  fails({place.scene, "--methods", "none.json"}, "none.json");
  fails({place.scene, "--methods", place.scene}, "scene.json");
  fails({place.scene, "--at", "-1"}, "--at");
  fails({place.scene, "--at", "2"}, "--at: expected a time within the scene's 1.0 s");
  fails({place.scene, "--rounds", "0"}, "--rounds");
  fails({place.scene, "--constraints", "soft"}, "--constraints: expected rigid or compliant");
  fails({place.scene, "--diagonals", "none"}, "--diagonals: expected one or both");
}

}  // namespace pleat
