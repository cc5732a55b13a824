#include "core/files/json_text.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"

using namespace pleat;

TEST_CASE("json text: control characters are escaped, other text stays", "[files]") {
  CHECK(printable("plain, 棉, é") == "plain, 棉, é");
  CHECK(printable("\x1b[31mred\nline") == "\\u001b[31mred\\u000aline");
  CHECK(printable("\x7f") == "\\u007f");
  CHECK(printable("\xc2\x9b|\xc2\xa0") == "\\u009b|\xc2\xa0");  // the C1 controls end at U+009F
  CHECK(printable(std::string_view("\0\xc2", 2)) == "\\u0000\xc2");
}

TEST_CASE("json text: long texts are cut between characters", "[files]") {
  const std::string sixty(60, 'x');
  CHECK(cut(sixty) == sixty);
  CHECK(cut(sixty + "y") == sixty + "...");
  CHECK(cut(std::string(59, 'x') + "棉棉") == std::string(59, 'x') + "...");
  CHECK(cut(std::string(100, '\x80')) == "...");  // no character begins anywhere
  CHECK(pointer_token(std::string(5000, 'k')) == std::string(60, 'k') + "...");
}

TEST_CASE("json text: what is not JSON is quoted", "[files]") {
  const auto complaint = [](std::string_view text) -> std::string {
    try {
      parse_json(text);
    } catch (const InputError& error) {
      return error.sentence();
    }
    return "none";
  };
  const std::string literal = " while parsing value - invalid literal";
  CHECK(complaint("{\"duration_s\": NaN}") == "expected JSON, got \"NaN\"" + literal);
  CHECK(complaint("[\x01") == "expected JSON, got \"<U+0001>\"" + literal);
  CHECK(complaint("[" + std::string(100, 'N')) ==
        "expected JSON, got \"" + std::string(59, 'N') + "..." + literal);
  CHECK(complaint("[\"it's").find("got \"\\\"it's\" while") != std::string::npos);
  CHECK(complaint("[-Infinity]").find("got \"-Infinity\" while") != std::string::npos);
}
