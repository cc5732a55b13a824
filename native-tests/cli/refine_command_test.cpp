#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "core/files/json_text.h"
#include "native-tests/support/small_scene.h"

using namespace pleat;

TEST_CASE("command: refine refuses an example, a plan or an option that it cannot use", "[cli]") {
  const SmallScene scene;
  write(scene.folder / "other.json", scene_with("\"columns\": 2", "\"columns\": 3"));
  write(scene.folder / "particles.json",
        R"({"cloth": {"particles": {"positions_m": [[0, 0, 0]], "masses_kg": [1]}}})");
  Json wild = parse_json(kSmallScene);
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
      {{scene.file, "--demand", "3"},
       "--demand: expected what the criterion shape may lose, from 0 to below 0.1 m, got 3"},
      {{scene.file, "--criterion", "curvature", "--demand", "8"},
       "--demand: expected a number from 0 to below 8, got 8"},
      {{scene.file, "--criterion", "bend"}, "--criterion: expected shape or curvature, got "},
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
    CHECK(n_lines(ending.error) == 1);
  }
}
