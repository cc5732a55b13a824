#include "core/deform/fabric_weights.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Printed less recomputed [percentage points].
struct PrintedSlip {
  int id;
  double recovery, stretch, bending;
};

/// The slips, to four digits after the point.
constexpr PrintedSlip kSlips[] = {{0, 0.0010, -0.0031, -0.0069},  {5, 0.0008, -0.0095, -0.0003},
                                  {8, 0.0000, -0.0135, 0.0135},   {9, -0.0035, -0.0089, 0.0124},
                                  {10, 0.1387, 0.0110, -0.1497},  {11, 0.5789, -0.0232, -0.5567},
                                  {12, -0.0044, -0.0552, -0.0044}};

DeformWeights printed_less_recomputed(const Fabric& fabric) {  // [percentage points]
  const DeformWeights weights = recomputed_weights(fabric.normalised);
  return {100 * (fabric.published_weights.recovery - weights.recovery),
          100 * (fabric.published_weights.stretch - weights.stretch),
          100 * (fabric.published_weights.bending - weights.bending)};
}

}  // namespace

TEST_CASE("fabric weights: eight fabrics have their printed weights within 0.006 points",
          "[deform]") {
  const int id = GENERATE(1, 2, 3, 4, 6, 7, 13, 14);
  const Fabric& fabric = fabric_library().fabrics[static_cast<std::size_t>(id)];
  CAPTURE(fabric.name);
  const DeformWeights slip = printed_less_recomputed(fabric);
  CHECK(std::abs(slip.recovery) < 0.006);
  CHECK(std::abs(slip.stretch) < 0.006);
  CHECK(std::abs(slip.bending) < 0.006);
}

TEST_CASE("fabric weights: the other seven are off by their known slips", "[deform]") {
  for (const PrintedSlip& known : kSlips) {
    const Fabric& fabric = fabric_library().fabrics[static_cast<std::size_t>(known.id)];
    CAPTURE(fabric.name);
    const DeformWeights slip = printed_less_recomputed(fabric);
    CHECK(slip.recovery == Approx(known.recovery).margin(6e-5));
    CHECK(slip.stretch == Approx(known.stretch).margin(6e-5));
    CHECK(slip.bending == Approx(known.bending).margin(6e-5));
  }
}

TEST_CASE("fabric weights: nylon's and gabardine's printed weights are those of other v'",
          "[deform]") {
  const auto [id, normalised] = GENERATE(table<std::size_t, GeometricMeasures>(
      {{10, {0.4418, 0.0089, 0.8033}}, {11, {1.0234, 0.0401, 0.9932}}}));
  const Fabric& fabric = fabric_library().fabrics[id];
  CAPTURE(fabric.name);
  const DeformWeights weights = recomputed_weights(normalised);
  CHECK(weights.recovery == Approx(fabric.published_weights.recovery).margin(6e-5));
  CHECK(weights.stretch == Approx(fabric.published_weights.stretch).margin(6e-5));
  CHECK(weights.bending == Approx(fabric.published_weights.bending).margin(6e-5));
}

TEST_CASE("fabric weights: they are shares of a whole, in proportion to the measures", "[deform]") {
  const DeformWeights weights = recomputed_weights({0.3, 0, 0.9});
  CHECK(weights.recovery == Approx(0.25).epsilon(1e-15));
  CHECK(weights.stretch == 0);
  CHECK(weights.bending == Approx(0.75).epsilon(1e-15));
}

TEST_CASE("fabric weights: measures without a share are refused", "[deform]") {
  CHECK_THROWS_AS(recomputed_weights({0, 0, 0}), ContractError);
  CHECK_THROWS_AS(recomputed_weights({0.5, -0.1, 0.5}), ContractError);
  CHECK_THROWS_AS(recomputed_weights({0.5, kNaN, 0.5}), ContractError);
  CHECK_THROWS_AS(recomputed_weights({0.5, HUGE_VAL, 0.5}), ContractError);
}

}  // namespace pleat
