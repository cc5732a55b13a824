#include <catch2/catch.hpp>
#include <string>

#include "native-tests/support/assets.h"
#include "native-tests/support/pleat_command.h"

namespace pleat {
namespace {

/// The text between the first `start` and the `end` that follows it.
std::string between(const std::string& text, const std::string& start, const std::string& end) {
  const std::size_t from = text.find(start);
  REQUIRE(from != std::string::npos);
  const std::size_t to = text.find(end, from + start.size());
  REQUIRE(to != std::string::npos);
  return text.substr(from + start.size(), to - from - start.size());
}

}  // namespace

TEST_CASE("readme: its first scene prints what is written below it", "[cli]") {
  const std::string page = repository_file("README.md");
  const ScratchFolder folder;
  write(folder / "silk.json", between(page, "```json\n", "```"));
  const Ending ending = pleat_command(
      folder, {"run", (folder / "silk.json").string(), "--out", (folder / "silk").string()});
  CAPTURE(ending.error);
  CHECK(ending.status == 0);
  CHECK(ending.out == between(page, "$ ./pleat run silk.json --out silk\n", "```"));
  CHECK_FALSE(text_of(folder / "silk/frame_000060.obj").empty());
  CHECK(text_of(folder / "silk/frame_000061.obj").empty());
}

}  // namespace pleat
