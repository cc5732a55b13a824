#include "core/model/air_drag.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/dynamics/stepper_table.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr double kSpeed = 3;  // [m/s]
const AirOptions kAir{1.2, 1.1, 0.15, {}};

Positions drag(const QuadMesh& mesh, const Positions& x, const Positions& v, double h) {
  AirDrag air(mesh.triangles(), kAir, mesh.n_vertices());
  Positions forces = Positions::Zero(3, mesh.n_vertices());
  const Positions others = forces;
  if (h == 0)
    air.add_forces(x, v, {}, forces);
  else
    air.set_damped_forces(x, v, 0.1 * mesh.vertex_areas(), {}, h, others, forces);
  return forces;
}

Positions everywhere(const Vec3& velocity, const QuadMesh& mesh) {
  return velocity.replicate(1, mesh.n_vertices());
}

double kinetic_energy(const Eigen::VectorXd& masses, const Positions& v) {
  return 0.5 * v.colwise().squaredNorm().dot(masses);
}

}  // namespace

TEST_CASE("air_drag: a flat sheet feels half rho A C v^2 against its motion", "[model]") {
  const QuadMesh mesh = sheet_with_aspect(4, 5, 0.9);
  const double dynamic_pressure = 0.5 * kAir.density * kSpeed * kSpeed;
  const double area = mesh.vertex_areas().sum();
  const Vec3 normal = Vec3::UnitZ();  // the sheet hangs in the plane z = 0
  const Vec3 tangent = Vec3::UnitY();
  const Vec3 across =
      drag(mesh, mesh.rest_positions(), everywhere(kSpeed * normal, mesh), 0).rowwise().sum();
  const Vec3 along =
      drag(mesh, mesh.rest_positions(), everywhere(kSpeed * tangent, mesh), 0).rowwise().sum();
  CHECK((across + dynamic_pressure * area * kAir.normal_coefficient * normal).norm() < 1e-13);
  CHECK((along + dynamic_pressure * area * kAir.tangent_coefficient * tangent).norm() < 1e-13);
  const Vec3 slanted = kSpeed * Vec3(0, 0.6, 0.8);
  const Vec3 oblique =
      drag(mesh, mesh.rest_positions(), everywhere(slanted, mesh), 0).rowwise().sum();
  CHECK((oblique + dynamic_pressure * area *
                       Vec3(0, 0.6 * kAir.tangent_coefficient, 0.8 * kAir.normal_coefficient))
            .norm() < 1e-13);
}

TEST_CASE("air_drag: still cloth and needle triangles feel nothing", "[model]") {
  const QuadMesh mesh = square_sheet(3);
  CHECK(drag(mesh, mesh.rest_positions(), everywhere(Vec3::Zero(), mesh), 0).isZero(0));
  const Positions point = Positions::Ones(3, mesh.n_vertices());
  CHECK(drag(mesh, point, everywhere(Vec3::UnitX(), mesh), 0.01).isZero(0));
}

TEST_CASE("air_drag: damped over a step h, it comes to the plain law in first order", "[model]") {
  Random random(1);
  const QuadMesh mesh = square_sheet(4);
  const Positions x = shaken(mesh.rest_positions(), 0.05, random);
  const Positions v = shaken(everywhere({0, 1, 2}, mesh), 0.5, random);
  const Positions law = drag(mesh, x, v, 0);
  const double coarse = (drag(mesh, x, v, 1e-4) - law).norm();
  const double fine = (drag(mesh, x, v, 1e-5) - law).norm();
  CHECK(coarse > 0);
  CHECK(coarse / fine == Approx(10).epsilon(0.02));
}

TEST_CASE("air_drag: with quads split both ways it is shared among vertices as mass is",
          "[model]") {
  const QuadMesh mesh = square_sheet(GENERATE(1, 2, 5));
  AirDrag air(mesh.crossed_triangles(), kAir, mesh.n_vertices(), 0.5);
  const Positions v = everywhere({0.3, -1, 2}, mesh);
  Positions forces = Positions::Zero(3, mesh.n_vertices());
  air.add_forces(mesh.rest_positions(), v, {}, forces);
  const Eigen::VectorXd areas = mesh.vertex_areas();
  const Vec3 per_area = forces.rowwise().sum() / areas.sum();
  CHECK(per_area.norm() > 0);
  for (int i = 0; i < mesh.n_vertices(); ++i)
    CHECK((forces.col(i) / areas[i] - per_area).norm() <= 1e-12 * per_area.norm());
}

TEST_CASE("air_drag: however long the step, damped drag only takes energy", "[model]") {
  const double h = std::pow(10.0, GENERATE(-3, -2, -1, 0, 2, 6));
  Random random(GENERATE(1, 2, 3, 4, 5));
  CAPTURE(h);
  const QuadMesh mesh = square_sheet(4);
  const Eigen::VectorXd masses = 0.1 * mesh.vertex_areas();
  const Positions x = shaken(mesh.rest_positions(), 0.2, random);
  const Positions v = shaken(everywhere({0, 2, 5}, mesh), 5, random);
  Positions after = v;
  const Positions forces = drag(mesh, x, v, h);
  for (int i = 0; i < mesh.n_vertices(); ++i) after.col(i) += h / masses[i] * forces.col(i);
  CHECK(kinetic_energy(masses, after) < kinetic_energy(masses, v));
}

TEST_CASE("air_drag: cloth falling flat keeps to the tanh law with every stepper", "[model]") {
  const QuadMesh mesh = square_sheet(3);
  ClothModel model = sheet_model(mesh, library_fabric("silk"));
  model.gravity = {0, 0, -9.81};
  model.masses.setZero();  // shared among corners as drag is, so that the sheet stays flat
  const double triangle_mass =
      library_fabric("silk").areal_density * mesh.vertex_areas().sum() / 18;
  for (const Triangle& t : mesh.triangles())
    for (const VertexId v : t) model.masses[v] += triangle_mass / 3;
  model.air.emplace(mesh.triangles(), kAir, mesh.n_vertices());
  const double density = model.masses.sum() / mesh.vertex_areas().sum();
  const double terminal = std::sqrt(2 * density * 9.81 / (kAir.density * kAir.normal_coefficient));
  constexpr double kDuration = 0.3;  // [s]
  const double exact = -terminal * std::tanh(9.81 * kDuration / terminal);
  for (MethodOptions options : converged_methods(0)) {
    double errors[2];
    for (int k = 0; k < 2; ++k) {
      const int n_steps = 600 << k;
      // The stiff springs stay at rest; only their stability bound asks for substeps.
      options.step = kDuration / n_steps;
      options.substeps = options.stepper == &steppers::kExplicitEuler ? 4 : 1;
      options.iterations = std::min(options.iterations, 5);
      State state = rest_state(mesh);
      const auto stepper = make_stepper(model, options);
      for (int s = 0; s < n_steps; ++s) REQUIRE(stepper->advance(state, s * options.step).ok());
      errors[k] = std::abs(state.velocities.row(2).mean() - exact);
    }
    CAPTURE(options.stepper->name, errors[0], errors[1]);
    CHECK(errors[0] < 0.005 * std::abs(exact));
    if (!options.stepper->is_single_precision) CHECK(errors[0] / errors[1] > 1.8);
  }
}

TEST_CASE(
    "air_drag: cloth falls at last as fast as its weight says, in light wind too, with "
    "every stepper that takes long steps",
    "[model]") {
  const double wind = GENERATE(0, 1e-3);  // [m/s], across the fall
  for (const StepperType* type :
       {&steppers::kProjective, &steppers::kImplicitEuler, &steppers::kNewton, &steppers::kImex})
    for (const char* name : {"chiffon", "silk", "linen", "canvas", "fine cotton"}) {
      const QuadMesh mesh = square_sheet(3);
      ClothModel model = sheet_model(mesh, library_fabric(name));
      model.gravity = {0, 0, -9.81};
      AirOptions air = kAir;
      air.wind.velocity = {wind, 0, 0};
      model.air.emplace(mesh.crossed_triangles(), air, mesh.n_vertices(), 0.5);
      const double density = model.masses.sum() / mesh.vertex_areas().sum();
      const double terminal =
          std::sqrt(2 * density * 9.81 / (air.density * air.normal_coefficient));
      MethodOptions options = type->usual_method();
      options.step = 1.0 / 60;
      options.substeps = 1;
      State state = rest_state(mesh);
      const auto stepper = make_stepper(model, options);
      const int n_steps = static_cast<int>(std::ceil(60 * 4 * terminal / 9.81));
      for (int s = 0; s < n_steps; ++s) REQUIRE(stepper->advance(state, s * options.step).ok());
      CAPTURE(type->name, name, wind);
      CHECK(-state.velocities.row(2).mean() == Approx(terminal).epsilon(0.01));
    }
}

TEST_CASE("air_drag: air without density or with negative drag is refused", "[model]") {
  CHECK_THROWS_AS(AirDrag({}, {0, 1, 0.1, {}}, 3), ContractError);
  CHECK_THROWS_AS(AirDrag({}, {1.2, -1, 0.1, {}}, 3), ContractError);
  CHECK_THROWS_AS(AirDrag({}, {1.2, 1, -0.1, {}}, 3), ContractError);
}

}  // namespace pleat
