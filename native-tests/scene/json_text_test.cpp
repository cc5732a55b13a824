#include "core/scene/json_text.h"

#include <catch2/catch.hpp>

using namespace pleat;

TEST_CASE("json text: control characters are escaped, other text stays", "[scene]") {
  CHECK(printable("plain, 棉, é") == "plain, 棉, é");
  CHECK(printable("\x1b[31mred\nline") == "\\u001b[31mred\\u000aline");
  CHECK(printable("\x7f") == "\\u007f");
  CHECK(printable("\xc2\x9b|\xc2\xa0") == "\\u009b|\xc2\xa0");  // the C1 controls end at U+009F
  CHECK(printable(std::string_view("\0\xc2", 2)) == "\\u0000\xc2");
}

TEST_CASE("json text: long texts are cut between characters", "[scene]") {
  const std::string sixty(60, 'x');
  CHECK(cut(sixty) == sixty);
  CHECK(cut(sixty + "y") == sixty + "...");
  CHECK(cut(std::string(59, 'x') + "棉棉") == std::string(59, 'x') + "...");
  CHECK(cut(std::string(100, '\x80')) == "...");  // no character begins anywhere
  CHECK(pointer_token(std::string(5000, 'k')) == std::string(60, 'k') + "...");
}
