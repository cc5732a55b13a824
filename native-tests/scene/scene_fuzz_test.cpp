#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/base/random.h"
#include "core/scene/scene_file.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

/// False when the text is refused as it should be; anything but InputError leaves the test.
bool is_scene(const std::string& text) {
  try {
    read_scene(text, fabric_library());
    return true;
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).substr(0, 9) == "expected ");
    return false;
  }
}

/// One to four small changes of the kind that hands and wires make.
std::string mutated(std::string text, Random& random) {
  static const char* const kPieces[] = {"-",  "1e309", "null", "[",     "]",        "{",
                                        "}",  "\"",    ",",    "NaN",   "0",        "-1",
                                        "[]", "{}",    "true", "\\u00", "\xff\xfe", "99999999999"};
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
  const auto seed = GENERATE(range(0, 7));
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
