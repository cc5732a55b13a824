#include <catch2/catch.hpp>
#include <cmath>

#include "core/dynamics/stepper_table.h"
#include "core/model/elasticity.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr double kDuration = 0.2;  // [s]

/// A soft sheet held at one corner, turning, stretched and falling: all terms of the model act and
/// nothing jumps.
struct SmoothProblem {
  QuadMesh mesh = sheet_with_aspect(3, 3, 1.2);
  ClothModel model = sheet_model(mesh, soft_fabric());
  State start = rest_state(mesh);

  SmoothProblem() {
    model.gravity = {0, -9.81, 0};
    Motion swing;
    swing.kind = Motion::Kind::oscillate;
    swing.offset = {0.05, 0, 0.02};
    swing.frequency = 1;
    model.pins.push_back({VertexId(0), start.positions.col(0), swing});
    for (int i = 0; i < mesh.n_vertices(); ++i) {
      const Eigen::Vector2d uv = mesh.rest_coordinates().col(i);
      start.positions.col(i) *= 1.1;
      start.velocities.col(i) = Vec3(0, 0, 1.5 * uv.y() + 0.5 * std::sin(3 * uv.x()));
    }
    start.positions.col(0) = model.pins[0].position(0);
  }
};

struct Rates {
  Positions positions, velocities;  // dx/dt [m/s], dv/dt [m/s^2]
};

Rates rates(const ClothModel& model, const State& state) {
  Positions forces = Positions::Zero(3, model.n_vertices());
  add_elastic_forces(model, state.positions, forces);
  add_damping_forces(model, state.positions, state.velocities, forces);
  add_gravity(model, forces);
  Rates result{state.velocities, forces * model.masses.cwiseInverse().asDiagonal()};
  for (const Pin& pin : model.pins) result.velocities.col(pin.vertex).setZero();
  return result;
}

/// A pinned vertex moves as its pin says.
void place_pins(const ClothModel& model, double time, State& state) {
  for (const Pin& pin : model.pins) {
    state.positions.col(pin.vertex) = pin.position(time);
    state.velocities.col(pin.vertex) = pin.velocity(time);
  }
}

/// Classical Runge-Kutta of order 4, sharing nothing with the steppers but the forces.
State reference_end(const SmoothProblem& problem, int n_steps) {
  const double h = kDuration / n_steps;
  const ClothModel& model = problem.model;
  State state = problem.start;
  place_pins(model, 0, state);
  const auto ahead = [&](const Rates& rate, double dt, double time) {
    State moved{state.positions + dt * rate.positions, state.velocities + dt * rate.velocities};
    place_pins(model, time, moved);
    return moved;
  };
  for (int s = 0; s < n_steps; ++s) {
    const double time = s * h;
    const Rates k1 = rates(model, state);
    const Rates k2 = rates(model, ahead(k1, h / 2, time + h / 2));
    const Rates k3 = rates(model, ahead(k2, h / 2, time + h / 2));
    const Rates k4 = rates(model, ahead(k3, h, time + h));
    const Rates mean{(k1.positions + 2 * k2.positions + 2 * k3.positions + k4.positions) / 6,
                     (k1.velocities + 2 * k2.velocities + 2 * k3.velocities + k4.velocities) / 6};
    state = ahead(mean, h, time + h);
  }
  return state;
}

double position_error(const State& found, const State& expected) {
  return (found.positions - expected.positions).norm() /
         std::sqrt(static_cast<double>(found.positions.cols()));
}

}  // namespace

TEST_CASE("steppers: halving the step halves the error on smooth motion", "[dynamics]") {
  SmoothProblem problem;
  const State reference = reference_end(problem, 4000);
  // The reference itself is good to far less than the errors it judges.
  REQUIRE(position_error(reference_end(problem, 2000), reference) < 1e-7);
  for (MethodOptions options : converged_methods(1)) {
    std::vector<double> errors;
    for (const int n_steps : {200, 400, 800}) {
      options.step = kDuration / n_steps;
      State state = problem.start;
      const auto stepper = make_stepper(problem.model, options);
      for (int s = 0; s < n_steps; ++s) REQUIRE(stepper->advance(state, s * options.step).ok());
      errors.push_back(position_error(state, reference));
    }
    CAPTURE(options.stepper->name, errors[0], errors[1], errors[2]);
    // The next order's term bends the slope; at these steps by less than a tenth.
    CHECK(std::log2(errors[0] / errors[1]) == Approx(1).margin(0.15));
    CHECK(std::log2(errors[1] / errors[2]) == Approx(1).margin(0.1));
    CHECK(errors[2] < 0.005);
  }
}

TEST_CASE("steppers: midpoint is of second order and rk4 of fourth", "[dynamics]") {
  SmoothProblem problem;
  const State reference = reference_end(problem, 4000);
  struct Method {
    const StepperType* stepper;
    int n_steps;
    double order;
  };
  const Method method =
      GENERATE(Method{&steppers::kNewton, 50, 2}, Method{&steppers::kRk4, 100, 4});
  std::vector<double> errors;
  for (const int refinement : {1, 2, 4}) {
    const int n_steps = refinement * method.n_steps;
    MethodOptions options;
    options.stepper = method.stepper;
    options.rule = NewtonRule::midpoint;
    options.solver = SolverKind::eigen;
    options.tolerance = kNewtonTolerance;
    options.step = kDuration / n_steps;
    State state = problem.start;
    const auto stepper = make_stepper(problem.model, options);
    for (int s = 0; s < n_steps; ++s) REQUIRE(stepper->advance(state, s * options.step).ok());
    errors.push_back(position_error(state, reference));
  }
  CAPTURE(method.stepper->name, errors[0], errors[1], errors[2]);
  CHECK(std::log2(errors[0] / errors[1]) == Approx(method.order).margin(0.25));
  CHECK(std::log2(errors[1] / errors[2]) == Approx(method.order).margin(0.15));
}

TEST_CASE("steppers: substeps are steps of their own length", "[dynamics]") {
  SmoothProblem problem;
  for (MethodOptions options : converged_methods(0.004)) {
    if (options.stepper->is_single_precision) continue;  // rounds to float32 between steps
    CAPTURE(options.stepper->name);
    options.substeps = 4;
    State in_substeps = problem.start;
    const auto coarse = make_stepper(problem.model, options);
    for (int s = 0; s < 10; ++s) REQUIRE(coarse->advance(in_substeps, s * options.step).ok());
    MethodOptions fine_options = options;
    fine_options.step = options.step / 4;
    fine_options.substeps = 1;
    State in_steps = problem.start;
    const auto fine = make_stepper(problem.model, fine_options);
    for (int s = 0; s < 40; ++s) REQUIRE(fine->advance(in_steps, s * fine_options.step).ok());
    CHECK(position_error(in_substeps, in_steps) < 1e-12);  // times round differently
  }
}

}  // namespace pleat
