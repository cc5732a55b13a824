#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "core/reference/reference.h"
#include "native-tests/support/small_scene.h"

using namespace pleat;

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
