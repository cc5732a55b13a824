#include <catch2/catch.hpp>
#include <cmath>

#include "core/dynamics/stepper_table.h"
#include "core/model/momentum.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

const QuadMesh& free_mesh() {
  static const QuadMesh mesh = sheet_with_aspect(4, 4, 1.2);
  return mesh;
}

/// Stretched, crumpled, drifting and turning; nothing acts on it from outside.
State tumbling_state() {
  Random random(1);
  State state = rest_state(free_mesh());
  state.positions = shaken(1.1 * state.positions, 0.05, random);
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i)
    state.velocities.col(i) =
        Vec3(1, -2, 0.5) + Vec3(0.5, 1, -2).cross(Vec3(state.positions.col(i)));
  return state;
}

State after(ClothModel& model, const MethodOptions& options, double duration) {
  State state = tumbling_state();
  const auto stepper = make_stepper(model, options);
  const auto n_steps = std::lround(duration / options.step);
  for (int s = 0; s < n_steps; ++s) REQUIRE(stepper->advance(state, s * options.step).ok());
  return state;
}

}  // namespace

TEST_CASE("steppers: without outer forces every one keeps the momentum", "[dynamics]") {
  ClothModel model = sheet_model(free_mesh(), soft_fabric());
  const Vec3 before = momentum(model, tumbling_state());
  for (const MethodOptions& options : converged_methods(0.002)) {
    CAPTURE(options.stepper->name);
    // 100 steps: rounding adds up like a random walk at worst; xpbd rounds to float32.
    const double tolerance = options.stepper->is_single_precision ? 1e-4 : 1e-11;
    CHECK((momentum(model, after(model, options, 0.2)) - before).norm() <
          tolerance * before.norm());
  }
}

TEST_CASE("steppers: projective keeps the momentum after any number of rounds", "[dynamics]") {
  ClothModel model = sheet_model(free_mesh(), soft_fabric());
  MethodOptions options = converged_methods(0.01)[2];
  options.iterations = GENERATE(1, 2, 7);
  options.acceleration = GENERATE(Acceleration::none, Acceleration::anderson);
  const Vec3 before = momentum(model, tumbling_state());
  CHECK((momentum(model, after(model, options, 0.2)) - before).norm() < 1e-11 * before.norm());
}

TEST_CASE("steppers: an iterative solver keeps the momentum, however loose its tolerance",
          "[dynamics]") {
  ClothModel model = sheet_model(free_mesh(), soft_fabric());
  MethodOptions options = converged_methods(0.002)[1];
  options.stepper = GENERATE(&steppers::kImplicitEuler, &steppers::kImex);
  options.solver = GENERATE(SolverKind::cg, SolverKind::sor);
  options.tolerance = GENERATE(0.3, 1e-3, 1e-6);
  const Vec3 before = momentum(model, tumbling_state());
  CHECK((momentum(model, after(model, options, 0.2)) - before).norm() < 1e-11 * before.norm());
}

TEST_CASE("steppers: explicit keeps the angular momentum to rounding", "[dynamics]") {
  // x+ = x + h v+ makes x+ x v+ = x x v+, and the forces have no moment about x.
  ClothModel model = sheet_model(free_mesh(), soft_fabric());
  const Vec3 before = angular_momentum(model, tumbling_state());
  const State end = after(model, converged_methods(0.002)[0], 0.2);
  CHECK((angular_momentum(model, end) - before).norm() < 1e-11 * before.norm());
}

TEST_CASE("steppers: backward Euler's loss of angular momentum falls with the step", "[dynamics]") {
  ClothModel model = sheet_model(free_mesh(), soft_fabric());
  const Vec3 before = angular_momentum(model, tumbling_state());
  const std::size_t which = GENERATE(1, 2);  // implicit, projective
  const StepperType* const kind = converged_methods(1)[which].stepper;
  const auto lost = [&](double step) {
    MethodOptions options = converged_methods(step)[which];
    options.iterations = 50;  // enough at such small steps
    return (angular_momentum(model, after(model, options, 0.2)) - before).norm() / before.norm();
  };
  const double coarse = lost(0.0004);
  const double fine = lost(0.0002);
  CAPTURE(kind->name, coarse, fine);
  CHECK(std::log2(coarse / fine) == Approx(1).margin(0.2));
  CHECK(fine < 0.05);
}

}  // namespace pleat
