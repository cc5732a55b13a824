#include "core/base/check.h"

#include <catch2/catch.hpp>

#include "core/base/ids.h"

namespace pleat {

TEST_CASE("check: a broken promise throws with its condition, place and sentence", "[base]") {
  try {
    PLEAT_CHECK(1 + 1 == 3, "sums are right");
    FAIL("nothing was thrown");
  } catch (const ContractError& error) {
    const std::string text = error.what();
    CHECK(text.find("1 + 1 == 3") != std::string::npos);
    CHECK(text.find("check_test.cpp") != std::string::npos);
    CHECK(text.find("sums are right") != std::string::npos);
  }
}

TEST_CASE("check: a kept promise is silent", "[base]") {
  CHECK_NOTHROW([] { PLEAT_CHECK(true, "always"); }());
}

TEST_CASE("check: an input error carries its place beside its sentence", "[base]") {
  const InputError error("/cloth/rows", "expected at least 1, got 0");
  CHECK(error.where() == "/cloth/rows");
  CHECK(error.sentence() == "expected at least 1, got 0");
  CHECK(std::string(error.what()) == "/cloth/rows: expected at least 1, got 0");
  CHECK(std::string(InputError("", "expected an object").what()) == "expected an object");
}

TEST_CASE("ids: an id made without an index is not valid", "[base]") {
  CHECK_FALSE(VertexId().valid());
  CHECK(VertexId(0).valid());
}

}  // namespace pleat
