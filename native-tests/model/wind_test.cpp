#include "core/model/wind.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/dynamics/stepper_table.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

const Vec3 kMean(6, 0, 0);

AirOptions air_in(const Vec3& velocity) {
  AirOptions air{1.2, 1.1, 0.15, {}};
  air.wind.velocity = velocity;
  return air;
}

/// The air's force on a sheet in the plane z = 0.
Vec3 force(const AirOptions& options, const Vec3& sheet_velocity) {
  const QuadMesh mesh = lying_sheet(4);
  AirDrag air(mesh.crossed_triangles(), options, mesh.n_vertices(), 0.5);
  Positions forces = Positions::Zero(3, mesh.n_vertices());
  air.add_forces(mesh.rest_positions(), sheet_velocity.replicate(1, mesh.n_vertices()), {}, forces);
  return forces.rowwise().sum();
}

/// Standard deviation in x, y and z about a mean.
Vec3 deviation(const Wind& wind, const Vec3& mean) {
  constexpr int kSamples = 200000;
  constexpr double kEvery = 0.05;  // [s]
  Vec3 squares(0, 0, 0);
  for (int s = 0; s < kSamples; ++s) squares += (wind.velocity(s * kEvery) - mean).cwiseAbs2();
  return (squares / kSamples).cwiseSqrt();
}

}  // namespace

TEST_CASE("wind: drag and lift of a plate at an angle follow from its normal and tangential parts",
          "[model]") {
  const double angle = GENERATE(0.0, 0.2, 0.7, 1.2, 1.5707963267948966);
  CAPTURE(angle);
  constexpr double kWindSpeed = 5;
  const Vec3 along(std::cos(angle), 0, std::sin(angle));  // seen from the plate
  const Vec3 across(-std::sin(angle), 0, std::cos(angle));
  const AirOptions air = air_in(kWindSpeed * along);
  const double q = 0.5 * air.density * kWindSpeed * kWindSpeed;  // force on 1 m^2
  const double s = std::sin(angle);
  const double c = std::cos(angle);
  const Vec3 total = force(air, Vec3::Zero());
  CHECK(total.dot(along) ==
        Approx(q * (air.normal_coefficient * s * s + air.tangent_coefficient * c * c)));
  CHECK(total.dot(across) ==
        Approx(q * (air.normal_coefficient - air.tangent_coefficient) * s * c).margin(1e-12));
  CHECK(std::abs(total.y()) < 1e-12);
}

TEST_CASE("wind: cloth feels how it moves through the air alone", "[model]") {
  const Vec3 wind(3, -1, 2);
  const Vec3 cloth(0.5, 2, -4);
  CHECK((force(air_in(wind), cloth) - force(air_in(Vec3::Zero()), cloth - wind)).norm() < 1e-13);
  CHECK(force(air_in(wind), wind).norm() < 1e-13);
}

TEST_CASE("wind: cloth hovers in an updraught of its terminal velocity with every stepper",
          "[model]") {
  const QuadMesh mesh = lying_sheet(3);
  ClothModel model = sheet_model(mesh, library_fabric("silk"));
  model.gravity = {0, 0, -9.81};
  AirOptions air = air_in(Vec3::Zero());
  const double density = model.masses.sum() / mesh.vertex_areas().sum();
  air.wind.velocity.z() = std::sqrt(2 * density * 9.81 / (air.density * air.normal_coefficient));
  model.air.emplace(mesh.crossed_triangles(), air, mesh.n_vertices(), 0.5);
  for (const MethodOptions& method : everyday_methods()) {
    CAPTURE(method.stepper->name);
    State state = rest_state(mesh);
    const auto stepper = make_stepper(model, method);
    for (int s = 0; s < 30; ++s) REQUIRE(stepper->advance(state, s * method.step).ok());
    // projective and position-based steppers take some substeps until they push with all of the
    // drag.
    const double fallen = (state.positions - mesh.rest_positions()).norm();
    const bool solves =
        method.stepper != &steppers::kProjective && !method.stepper->is_single_precision;
    CHECK(fallen < (solves ? 1e-9 : 0.02));
    CHECK(state.velocities.norm() < (solves ? 1e-9 : 1e-3));
  }
}

TEST_CASE("wind: cloth that nothing else pulls at comes to move with it", "[model]") {
  const QuadMesh mesh = lying_sheet(3);
  ClothModel model = sheet_model(mesh, library_fabric("chiffon"));
  model.gravity.setZero();
  const Vec3 wind(0, 0, 4);
  model.air.emplace(mesh.crossed_triangles(), air_in(wind), mesh.n_vertices(), 0.5);
  for (const MethodOptions& method : everyday_methods()) {
    CAPTURE(method.stepper->name);
    State state = rest_state(mesh);
    const auto stepper = make_stepper(model, method);
    for (int s = 0; s < 240; ++s) REQUIRE(stepper->advance(state, s * method.step).ok());
    // v' = -(U - v)^2 / length: after t it lacks U / (1 + U t / length).
    const double length = 2 * model.masses.sum() / (1.2 * 1.1);
    const double lacks = 4 / (1 + 4 * 4 / length);
    CHECK(4 - state.velocities.row(2).mean() == Approx(lacks).epsilon(0.3));
  }
}

TEST_CASE("wind: gusts repeat with their seed, and differ without", "[model]") {
  const WindOptions gusty{kMean, 0.2, 7};
  const Wind wind(gusty);
  const Wind again(gusty);
  const Wind other({kMean, 0.2, 8});
  for (const double time : {0.0, 0.3, 17.0}) {
    CHECK(wind.velocity(time) == again.velocity(time));
    CHECK((wind.velocity(time) - other.velocity(time)).norm() > 1e-3);
  }
}

TEST_CASE("wind: gusts have the strength they are given, less across and upward", "[model]") {
  const double intensity = GENERATE(0.1, 0.25);
  const Vec3 deviations = deviation(Wind({kMean, intensity, 3}), kMean);
  CHECK(deviations.x() == Approx(intensity * 6).epsilon(0.02));
  CHECK(deviations.z() == Approx(0.80 * intensity * 6).epsilon(0.02));
  CHECK(deviations.y() == Approx(0.52 * intensity * 6).epsilon(0.02));
  CHECK(Wind({kMean, 0, 3}).velocity(5) == kMean);
}

TEST_CASE("wind: upright wind has gusts in all directions too", "[model]") {
  const Vec3 up(0, 3, 0);
  const Vec3 deviations = deviation(Wind({up, 0.2, 3}), up);
  CHECK(deviations.minCoeff() > 0.25);
  CHECK(deviations.y() == Approx(0.6).epsilon(0.02));
}

}  // namespace pleat
