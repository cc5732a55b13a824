#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/dynamics/explicit/stability_bound.h"
#include "core/model/elasticity.h"
#include "core/run/scene_model.h"
#include "core/run/simulation.h"
#include "core/scene/cloth/knit_cloth.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/rest_cloth.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

constexpr int kSide = 24;  // particles

ClothModel knit_model(const KnitCloth& cloth, const ModelOptions& options = {}) {
  Scene scene;
  scene.cloth = cloth;
  scene.model = options;
  return scene_model(scene, rest_cloth(scene));
}

std::int64_t count(const ClothModel& model, SpringKind kind) {
  return std::count_if(model.springs.begin(), model.springs.end(),
                       [kind](const Spring& spring) { return spring.kind == kind; });
}

/// The spring that joins two columns of the first rows.
Spring spring_from(const ClothModel& model, SpringKind kind, int column, int other_column) {
  const auto found =
      std::find_if(model.springs.begin(), model.springs.end(), [&](const Spring& spring) {
        return spring.kind == kind && spring.a % kSide == column &&
               spring.b % kSide == other_column;
      });
  REQUIRE(found != model.springs.end());
  return *found;
}

}  // namespace

TEST_CASE("knit: neighbours, diagonals and every second particle are joined", "[scene]") {
  const ClothModel model = knit_model({});
  CHECK(model.n_vertices() == kSide * kSide);
  CHECK(count(model, SpringKind::warp) == 552);
  CHECK(count(model, SpringKind::weft) == 552);
  CHECK(count(model, SpringKind::shear) == 1058);
  CHECK(count(model, SpringKind::bend) == 1056);
  CHECK(model.masses.sum() == Approx(0.576));
  const double cell = 1.0 / (kSide - 1);
  const auto steps = [](const Spring& spring) { return spring.b - spring.a; };
  for (const Spring& spring : model.springs) {
    switch (spring.kind) {
      case SpringKind::warp:
        CHECK(steps(spring) == kSide);
        CHECK(spring.rest_length == Approx(cell));
        break;
      case SpringKind::weft:
        CHECK(steps(spring) == 1);
        CHECK(spring.rest_length == Approx(cell));
        break;
      case SpringKind::shear:
        CHECK(std::abs(steps(spring) - kSide) == 1);
        CHECK(spring.rest_length == Approx(std::sqrt(2) * cell));
        break;
      default:
        CHECK((steps(spring) == 2 * kSide || steps(spring) == 2));
        CHECK(spring.rest_length == Approx(2 * cell));
    }
  }
}

TEST_CASE("knit: no spring leads around the edge to another row", "[scene]") {
  KnitCloth cloth;
  cloth.shape.columns = GENERATE(1, 2, 5);
  cloth.shape.rows = GENERATE(1, 3);
  cloth.shape.width = 0.1 * cloth.shape.columns;
  cloth.shape.height = 0.1 * cloth.shape.rows;
  for (const Spring& spring : knit_model(cloth).springs) CHECK(spring.rest_length < 0.21);
}

// A stretch e along the wales: their springs are longer by e a, those of bending by 2 e a, and the
// diagonals by d. Wales count as 16 plain and 8 of lace with 0.6, so 20.8; between neighbours are
// the means, 20.8 less half of each border wale.
TEST_CASE("knit: a uniform stretch costs what its springs cost one by one", "[scene]") {
  KnitCloth cloth;
  cloth.shape.height = 1.5;
  const ClothModel model = knit_model(cloth);
  const double e = GENERATE(0.1, -0.05);
  Positions x = cloth.at_rest(0).start;
  CHECK(elastic_energy(model, x) == Approx(0).margin(1e-20));
  x.row(1) *= 1 + e;
  const double a = 1.5 / 23;
  const double b = 1.0 / 23;
  const double d = std::hypot((1 + e) * a, b) - std::hypot(a, b);
  const double expected =
      0.5 * (23 * 20.8 * 10000 * std::pow(e * a, 2) + 2 * 23 * 19.8 * 4000 * std::pow(d, 2) +
             22 * 20.8 * 900 * std::pow(2 * e * a, 2));
  CHECK(elastic_energy(model, x) == Approx(expected).epsilon(1e-10));
}

TEST_CASE("knit: a spring takes the mean of its ends' wales, a damper does not", "[scene]") {
  const ClothModel model = knit_model({});
  const auto share = [&](SpringKind kind, double whole, int column, int other) {
    return spring_from(model, kind, column, other).stiffness / whole;
  };
  CHECK(share(SpringKind::warp, 10000, 5, 5) == 1);
  CHECK(share(SpringKind::warp, 10000, 6, 6) == Approx(0.6));
  CHECK(share(SpringKind::warp, 10000, 9, 9) == Approx(0.6));
  CHECK(share(SpringKind::warp, 10000, 10, 10) == 1);
  CHECK(share(SpringKind::weft, 10000, 4, 5) == 1);
  CHECK(share(SpringKind::weft, 10000, 5, 6) == Approx(0.8));
  CHECK(share(SpringKind::weft, 10000, 6, 7) == Approx(0.6));
  CHECK(share(SpringKind::shear, 4000, 9, 10) == Approx(0.8));
  CHECK(share(SpringKind::shear, 4000, 10, 9) == Approx(0.8));
  CHECK(share(SpringKind::bend, 900, 4, 6) == Approx(0.8));
  CHECK(share(SpringKind::bend, 900, 6, 8) == Approx(0.6));
  for (const Spring& spring : model.springs)
    CHECK(spring.damping == (spring.kind == SpringKind::bend ? 0.7 : 0.5));
}

TEST_CASE("knit: without lace all wales are alike", "[scene]") {
  KnitCloth cloth;
  cloth.pattern.lace_columns = 0;
  for (const Spring& spring : knit_model(cloth).springs)
    if (is_structural(spring.kind)) CHECK(spring.stiffness == 10000);
}

TEST_CASE("knit: a model without shear or bending lacks their springs", "[scene]") {
  ModelOptions options;
  options.shear = false;
  CHECK(count(knit_model({}, options), SpringKind::shear) == 0);
  CHECK(knit_model({}, options).springs.size() == 1104 + 1056);
  options.bending = BendingModel::none;
  CHECK(knit_model({}, options).springs.size() == 1104);
  const BuildReport with = build_report(knit_model({}), {});
  const BuildReport without = build_report(knit_model({}, options), options);
  const auto has = [](const std::vector<std::string>& parts) {
    return std::find(parts.begin(), parts.end(), "bending") != parts.end();
  };
  CHECK(has(with.built));
  CHECK(has(without.left_out));
}

// 59600 N/m and c = 6.8 N s/m meet at a particle of 1 g: h = 2 m / (c + sqrt(c^2 + 2 m k)). A
// thousand times the damping rules alone.
TEST_CASE(
    "knit: explicit steps are a tenth of a millisecond, or with damping per millimetre a seventh "
    "of a microsecond",
    "[scene]") {
  KnitCloth cloth;
  cloth.pattern.lace_columns = 0;
  const double c = 6.8;
  CHECK(largest_stable_step(knit_model(cloth)) ==
        Approx(2e-3 / (c + std::sqrt(c * c + 2e-3 * 59600))));
  cloth.structural.damping = cloth.shear.damping = 500;
  cloth.bending.damping = 700;
  CHECK(largest_stable_step(knit_model(cloth)) == Approx(1e-3 / 6800).epsilon(1e-3));
}

TEST_CASE("knit: every stepper lets it swing from its upper edge", "[scene]") {
  const char* const stepper =
      GENERATE("implicit", "imex", "projective", "xpbd", "pbd", "explicit", "rk4", "newton");
  CAPTURE(stepper);
  const Scene scene = read_scene(
      R"({"cloth": {"knit": {"wale_direction": [0, 0, 1]}}, "pins": [{"part": "upper_edge"}],
          "method": {"stepper": ")" +
          std::string(stepper) + R"("}})",
      fabric_library());
  Simulation simulation(scene);
  for (int n = 0; n < 3; ++n) REQUIRE(simulation.step().ok());
  const Positions& x = simulation.state().positions;
  CHECK(x.leftCols(kSide) == simulation.rest_positions().leftCols(kSide));
  const double fall = 0.5 * 9.81 * std::pow(3.0 / 60, 2);
  CHECK(x.bottomRows(2).topRows(1).rightCols(kSide).maxCoeff() < -0.8 * fall);
  CHECK(x.row(1).minCoeff() > -3 * fall);
}

}  // namespace pleat
