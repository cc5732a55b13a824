#include "core/model/energy_ledger.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "core/dynamics/stepper_table.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/models.h"

using namespace pleat;

namespace {

/// A system to account for, made anew for each run.
struct Case {
  const char* name;
  std::function<ClothModel()> model;
  std::function<State(const ClothModel&)> state;
  double duration;  // [s]
};

ClothModel pendulum_model() {
  Chain chain;
  chain.n_springs = 1;
  chain.length = 0.5;
  return chain_model(chain);
}

ClothModel soft_chain_model() {
  Chain chain;
  chain.n_springs = 4;
  chain.stiffness = 100;
  return chain_model(chain);
}

/// Horizontal, at rest.
State released_state(const ClothModel& model) {
  State state{Positions::Zero(3, model.n_vertices()), Positions::Zero(3, model.n_vertices())};
  double x = 0;
  for (int i = 1; i < model.n_vertices(); ++i) {
    x += model.springs[static_cast<std::size_t>(i - 1)].rest_length;
    state.positions(0, i) = x;
  }
  return state;
}

ClothModel damped_chain_model() {
  ClothModel model = soft_chain_model();
  for (Spring& spring : model.springs) spring.damping = 0.05;
  model.damping_direction = DampingDirection::isotropic;
  return model;
}

ClothModel moving_pin_model() {
  ClothModel model = soft_chain_model();
  model.pins.front().motion = {Motion::Kind::oscillate, Vec3(0.05, 0.02, 0.03), 0, 0, 1.5};
  return model;
}

ClothModel particle_model(double mass) {
  ClothModel model;
  model.masses = Eigen::VectorXd::Constant(1, mass);
  return model;
}

ClothModel sliding_model() {
  ClothModel model = particle_model(0.3);
  Collider floor;
  floor.shape = Plane{};
  floor.friction = 0.2;
  model.contact.emplace(std::vector<Collider>{floor}, ContactOptions{});
  return model;
}

State thrown_state(const ClothModel&) {
  State state{Positions::Zero(3, 1), Positions::Zero(3, 1)};
  state.positions.col(0) = Vec3(0, 0.3, 0);
  state.velocities.col(0) = Vec3(2, 0, 0.5);
  return state;
}

ClothModel falling_sheet_model() {
  ClothModel model = sheet_model(square_sheet(2), soft_fabric());
  model.gravity = Vec3(0, -9.81, 0);
  model.air.emplace(square_sheet(2).triangles(), AirOptions{}, model.n_vertices());
  return model;
}

State flat_state(const ClothModel& model) {
  State state{Positions(3, model.n_vertices()), Positions::Zero(3, model.n_vertices())};
  for (int i = 0; i < model.n_vertices(); ++i)
    state.positions.col(i) =
        Vec3(square_sheet(2).rest_positions()(0, i), 0, square_sheet(2).rest_positions()(1, i));
  return state;
}

/// Lies level, held in its first two lines, and hangs over as far as friction lets it.
QuadMesh shelf_sheet() {
  SheetShape shape;
  shape.height = shape.width = 0.2;
  shape.columns = 2;
  shape.rows = 4;
  shape.warp_direction = Vec3::UnitX();
  shape.weft_direction = Vec3::UnitZ();
  return QuadMesh::sheet(shape);
}

ClothModel rubbing_sheet_model() {
  const QuadMesh mesh = shelf_sheet();
  ClothModel model = sheet_model(mesh, soft_fabric());
  model.gravity = Vec3(0, -9.81, 0);
  for (int i = 0; i < 6; ++i) model.pins.push_back({VertexId(i), mesh.rest_positions().col(i), {}});
  model.pins[4].motion = {Motion::Kind::oscillate, Vec3(0, 0.01, 0), 0, 0, 3};
  model.bend_friction.emplace(line_bends(mesh, 1), 0.02, mesh.crossed_triangles(),
                              mesh.rest_positions());
  return model;
}

State shelf_state(const ClothModel&) { return rest_state(shelf_sheet()); }

std::vector<Case> cases() {
  return {{"pendulum", pendulum_model, released_state, 0.5},
          {"chain", soft_chain_model, released_state, 0.5},
          {"damped chain", damped_chain_model, released_state, 0.5},
          {"moving pin", moving_pin_model, released_state, 0.5},
          {"contact", sliding_model, thrown_state, 0.8},
          {"drag", falling_sheet_model, flat_state, 0.5}};
}

/// One spring with a weight at its end, held up at its rest length.
ClothModel spring_balance_model() {
  Chain chain;
  chain.n_springs = 1;
  return chain_model(chain);
}

State unstretched_state(const ClothModel& model) {
  State state{Positions::Zero(3, 2), Positions::Zero(3, 2)};
  state.positions(1, 1) = -model.springs.front().rest_length;
  return state;
}

struct Account {
  double largest_drift = 0;  // maximum over all steps [J]
  double relative_drift = 0;
  EnergyLedger::Works works;
  EnergyParts first_parts;
  EnergyParts parts;
};

Account account(const Case& wanted, const StepperType* stepper, double step) {
  ClothModel model = wanted.model();
  State state = wanted.state(model);
  MethodOptions method;
  method.stepper = stepper;
  method.step = step;
  method.solver = SolverKind::eigen;
  const auto simulated = make_stepper(model, method);
  EnergyLedger ledger(model, state);
  Account result;
  const int n_steps = static_cast<int>(std::lround(wanted.duration / step));
  for (int s = 0; s < n_steps; ++s) {
    const State begin = state;
    REQUIRE(simulated->advance(state, s * step).ok());
    ledger.record(begin, state, (s + 1) * step, step);
    result.largest_drift = std::max(result.largest_drift, std::abs(ledger.drift()));
  }
  result.relative_drift = ledger.relative_drift();
  result.works = ledger.works();
  result.first_parts = ledger.first_parts();
  result.parts = ledger.parts();
  return result;
}

}  // namespace

// Both steppers are of first order, so what they gain or lose by themselves falls with the step,
// and what the ledger misses does too. An impact falls anywhere in its step, so a few times more or
// less than an eighth is one case of many.
TEST_CASE("energy_ledger: the drift falls in proportion to the step", "[model]") {
  const auto stepper = GENERATE(&steppers::kExplicitEuler, &steppers::kImplicitEuler);
  const Case wanted = cases()[GENERATE(range(std::size_t{0}, std::size_t{6}))];
  CAPTURE(wanted.name, stepper->name);
  const Account coarse = account(wanted, stepper, 1.0 / 1000);
  const Account fine = account(wanted, stepper, 1.0 / 8000);
  CHECK(fine.largest_drift < 0.25 * coarse.largest_drift);
  CHECK(fine.relative_drift < 0.02);
}

TEST_CASE("energy_ledger: impact and friction take all of a sliding particle's energy", "[model]") {
  Case sliding = cases()[4];
  const double speed_squared = 2 * 2 + 0.5 * 0.5;
  sliding.duration = 2;  // friction alone stops it within v / (mu g) = 1.05 s of the impact
  const Account found = account(sliding, &steppers::kExplicitEuler, 1.0 / 8000);
  CHECK(found.works.contact == Approx(-0.3 * (9.81 * 0.3 + speed_squared / 2)).epsilon(0.001));
  CHECK(found.works.damping == 0);
  CHECK(found.works.pins == 0);
}

TEST_CASE("energy_ledger: a pin that does not move does no work", "[model]") {
  const Case chain = cases()[GENERATE(0, 1, 2)];
  const Account found = account(chain, &steppers::kImplicitEuler, 1.0 / 1000);
  CHECK(found.works.pins == 0);
}

TEST_CASE("energy_ledger: dampers and air only take energy", "[model]") {
  CHECK(account(cases()[2], &steppers::kImplicitEuler, 1.0 / 1000).works.damping < 0);
  CHECK(account(cases()[5], &steppers::kImplicitEuler, 1.0 / 1000).works.air < 0);
}

TEST_CASE("energy_ledger: inner friction takes what its law says", "[model]") {
  const auto stepper = GENERATE(&steppers::kNewton, &steppers::kImplicitEuler);
  const Case rubbing{"inner friction", rubbing_sheet_model, shelf_state, 0.5};
  CAPTURE(stepper->name);
  const Account coarse = account(rubbing, stepper, 1.0 / 1000);
  const Account fine = account(rubbing, stepper, 1.0 / 8000);
  CHECK(fine.works.bend_friction < -0.1 * fine.parts.elastic);
  CHECK(fine.works.bend_friction == Approx(coarse.works.bend_friction).epsilon(0.05));
  CHECK(fine.largest_drift < 0.25 * coarse.largest_drift);
  Case smooth = rubbing;
  smooth.model = [] {
    ClothModel model = rubbing_sheet_model();
    model.bend_friction.reset();
    return model;
  };
  const Account without = account(smooth, stepper, 1.0 / 8000);
  CHECK(fine.largest_drift < 1.2 * without.largest_drift);
}

// x = x0 (1 - cos omega t) below the rest length, with x0 = m g / k and omega^2 = k / m.
TEST_CASE("energy_ledger: a weight let go on a spring has its closed-form energies", "[model]") {
  const double turns = GENERATE(0.0, 0.25, 0.5, 1.0, 1.7);
  CAPTURE(turns);
  const ClothModel model = spring_balance_model();
  const double mass = model.masses[1];
  const double stiffness = model.springs.front().stiffness;
  const double omega = std::sqrt(stiffness / mass);
  const double weight = mass * 9.81;
  Case balance{"balance", spring_balance_model, unstretched_state, turns * 2 * kPi / omega};
  const Account found = account(balance, &steppers::kRk4, 2 * kPi / omega / 1000);
  const double speed = weight / stiffness * omega * std::sin(turns * 2 * kPi);
  const double depth = weight / stiffness * (1 - std::cos(turns * 2 * kPi));
  const double scale = weight * weight / stiffness;
  CHECK(found.first_parts.kinetic == 0);
  CHECK(found.first_parts.elastic == 0);
  CHECK(found.parts.kinetic == Approx(mass * speed * speed / 2).margin(1e-9 * scale));
  CHECK(found.parts.elastic == Approx(stiffness * depth * depth / 2).margin(1e-9 * scale));
  CHECK(found.parts.gravity - found.first_parts.gravity ==
        Approx(-weight * depth).margin(1e-9 * scale));
}

TEST_CASE("energy_ledger: of a pendulum without friction nothing is lost", "[model]") {
  const Account found = account(cases()[0], &steppers::kRk4, 1.0 / 8000);
  CHECK(found.relative_drift < 1e-6);
  CHECK(found.works.sum() == 0);
  CHECK(found.parts.sum() == Approx(found.first_parts.sum()).margin(1e-6 * found.parts.kinetic));
}
