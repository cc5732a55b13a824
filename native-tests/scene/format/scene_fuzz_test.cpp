#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/base/random.h"
#include "core/scene/format/scene_file.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

constexpr const char* kObj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 0.5 0\nvt 0 0.5\n"
    "o cloth\nf 1/1 2/2 4/3\ng hem\nf 2/2/7 3/-1/7 4/3/7\nl 1 -1 \\\n 2\np 3\n";

constexpr const char* kMeshScene = R"({"cloth": {"mesh": {
  "positions_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 0, 2]], "triangles": [[0, 1, 2], [2, 1, 3]],
  "warp_directions": [[1, 0, 0], [1, -1, 1]], "texture_coordinates": [[0, 0], [1, 0], [0, 2], [1, 4]],
  "groups": {"low": [0, 1, 2], "fold": [1, 2]}, "initial_velocity_m_per_s": [0, 0.5, 0]}},
  "refinement": {"level": 1},
  "pins": [{"part": "fold"}, {"vertices": [3]}, {"box": {"low_m": [-1, 0, 0], "high_m": [0.5, 1, 3]}}]})";

const char* const kFileScene =
    R"({"cloth": {"mesh": {"obj": "a.obj", "warp_direction": [0, 0, 1]}}, "pins": [{"part": "hem"}]})";

/// False when the text is refused as it should be; anything but InputError leaves the test.
bool is_scene(const std::string& text, const std::string& obj = kObj) {
  try {
    read_scene(text, fabric_library(), [&](const std::string&) { return obj; });
    return true;
  } catch (const InputError& error) {
    CHECK(error.sentence().substr(0, 9) == "expected ");
    return false;
  }
}

/// One to four small changes of the kind that hands and wires make.
std::string mutated(std::string text, Random& random) {
  static constexpr const char* kPieces[] = {
      "-",   "1e309", "null", "[",  "]",  "{",    "}",     "\"",       ",",
      "NaN", "0",     "-1",   "[]", "{}", "true", "\\u00", "\xff\xfe", "99999999999"};
  for (std::int64_t n = 1 + random.below(4); n > 0; --n) {
    const auto at =
        static_cast<std::size_t>(random.below(static_cast<std::int64_t>(text.size()) + 1));
    switch (random.below(4)) {
      case 0:
        text.insert(at, kPieces[random.below(std::size(kPieces))]);
        break;
      case 1:
        text.erase(at, static_cast<std::size_t>(1 + random.below(8)));
        break;
      case 2:
        if (at < text.size()) text[at] = static_cast<char>(random.below(256));
        break;
      default:
        text.insert(at, text.substr(static_cast<std::size_t>(
                                        random.below(static_cast<std::int64_t>(text.size()) + 1)),
                                    static_cast<std::size_t>(random.below(40))));
    }
  }
  return text;
}

}  // namespace

TEST_CASE("scene file: a text cut anywhere is refused", "[scene]") {
  for (const char* name : kSceneFiles) {
    std::string text = scene_text(name);
    while (!text.empty() && text.back() != '}') text.pop_back();
    REQUIRE(is_scene(text));
    for (std::size_t length = 0; length < text.size(); ++length) {
      CAPTURE(name, length);
      REQUIRE_FALSE(is_scene(text.substr(0, length)));
    }
  }
}

TEST_CASE(
    "scene file: a spoilt text is read or refused, and what is read can be written and read again",
    "[scene]") {
  const auto seed = GENERATE(range(0, 9));
  CAPTURE(seed);
  Random random(static_cast<std::uint64_t>(seed));
  const std::string text = scene_text(kSceneFiles[seed]);
  int n_read = 0;
  int n_refused = 0;
  for (int round = 0; round < 1500; ++round) {
    const std::string spoilt = mutated(text, random);
    CAPTURE(spoilt);
    if (!is_scene(spoilt)) {
      ++n_refused;
      continue;
    }
    ++n_read;
    const std::string written = write_scene(read_scene(spoilt, fabric_library()));
    REQUIRE(is_scene(written));
  }
  // Neither an all-refusing nor an all-accepting reader passes.
  CHECK(n_read > 20);
  CHECK(n_refused > 500);
}

TEST_CASE("scene file: a mesh scene cut or spoilt anywhere is read or refused", "[scene]") {
  const std::string text = kMeshScene;
  REQUIRE(is_scene(text));
  for (std::size_t length = 0; length < text.size(); ++length) {
    CAPTURE(length);
    REQUIRE_FALSE(is_scene(text.substr(0, length)));
  }
  Random random(16);
  int n_read = 0;
  for (int round = 0; round < 3000; ++round) {
    const std::string spoilt = mutated(text, random);
    CAPTURE(spoilt);
    if (!is_scene(spoilt)) continue;
    ++n_read;
    const std::string written = write_scene(read_scene(spoilt, fabric_library()));
    REQUIRE(write_scene(read_scene(written, fabric_library())) == written);
  }
  CHECK(n_read > 10);
  CHECK(n_read < 2000);
}

TEST_CASE("scene file: an OBJ file cut or spoilt anywhere is read or refused", "[scene]") {
  const std::string text = kObj;
  REQUIRE(is_scene(kFileScene, text));
  Random random(17);
  int n_read = 0;
  for (int round = 0; round < 5000; ++round) {
    std::string spoilt = mutated(text, random);
    if (round % 5 == 0)
      spoilt.resize(static_cast<std::size_t>(random.below(static_cast<std::int64_t>(text.size()))));
    CAPTURE(spoilt);
    if (!is_scene(kFileScene, spoilt)) continue;
    ++n_read;
    const Scene scene =
        read_scene(kFileScene, fabric_library(), [&](const std::string&) { return spoilt; });
    const std::string written = write_scene(scene);
    REQUIRE(write_scene(read_scene(written, fabric_library())) == written);
  }
  CHECK(n_read > 50);
  CHECK(n_read < 4000);
}

TEST_CASE("fabric file: a spoilt text is read or refused", "[scene]") {
  Random random(15);
  const std::string text = repository_file("assets/fabrics/fabrics.json");
  int n_refused = 0;
  for (int round = 0; round < 60; ++round) {
    try {
      read_fabrics(mutated(text, random));
    } catch (const InputError&) {
      ++n_refused;
    }
  }
  CHECK(n_refused > 10);
}

}  // namespace pleat
