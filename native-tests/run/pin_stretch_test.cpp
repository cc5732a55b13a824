#include "core/run/pin_stretch.h"

#include <catch2/catch.hpp>

#include "core/base/random.h"

namespace pleat {
namespace {

std::vector<Pin> pins_at(std::initializer_list<int> vertices) {
  std::vector<Pin> pins;
  for (const int v : vertices) pins.push_back({VertexId(v), {0, 0, 0}, {}});
  return pins;
}

/// Answer of one that looks for the first time.
double afresh(const std::vector<Pin>& pins, const Positions& rest, const Positions& now) {
  return PinStretch().largest(pins, rest, now);
}

Positions scattered(int n, std::uint64_t seed) {
  Random random(seed);
  Positions places(3, n);
  for (double& x : places.reshaped()) x = random.uniform(-1, 1);
  return places;
}

}  // namespace

TEST_CASE("pin_stretch: the pair that is pulled the most counts, of pins alone", "[run]") {
  Positions rest = Positions::Zero(3, 4);
  rest.row(0) << 0, 1, 3, 4;
  Positions now = rest;
  now.row(0) << 0, 1.2, 3, 40;
  CHECK(afresh(pins_at({0, 1, 2}), rest, now) == Approx(0.2));
  CHECK(afresh(pins_at({0, 2}), rest, now) == 0);
  CHECK(afresh(pins_at({1}), rest, now) == 0);
  CHECK(afresh({}, rest, now) == 0);
}

TEST_CASE("pin_stretch: pins that all go one way ask for what they asked for before", "[run]") {
  const Positions rest = scattered(40, 1);
  const Positions begin = scattered(40, 2);
  std::vector<Pin> pins;
  for (int v = 0; v < 40; v += 3) pins.push_back({VertexId(v), {0, 0, 0}, {}});
  PinStretch kept;
  const double first = kept.largest(pins, rest, begin);
  REQUIRE(first > 0);
  for (int step = 1; step <= 10; ++step) {
    Positions now = begin.colwise() + step * Vec3(0.1, -0.7, 0.3);
    now.col(1) *= 2;  // no pin
    CHECK(kept.largest(pins, rest, now) == first);
    CHECK(afresh(pins, rest, now) == Approx(first).epsilon(1e-12));
  }
}

TEST_CASE("pin_stretch: pins that move against each other, come or go are seen", "[run]") {
  const Positions rest = scattered(12, 3);
  Positions now = rest;
  std::vector<Pin> pins = pins_at({0, 4, 8});
  PinStretch kept;
  const auto check = [&] { CHECK(kept.largest(pins, rest, now) == afresh(pins, rest, now)); };
  check();
  now.col(8) += 1e-9 * (now.col(8) - now.col(0));
  CHECK(afresh(pins, rest, now) > 0);
  check();
  now.col(4) *= 3;
  check();
  now.col(11) *= 5;
  pins.push_back({VertexId(11), {0, 0, 0}, {}});
  check();
  pins[1].vertex = VertexId(5);
  check();
  pins.pop_back();
  check();
}

}  // namespace pleat
