#include "core/dynamics/stepper_table.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/check.h"
#include "core/linalg/make_linear_solver.h"
#include "native-tests/support/allocation_count.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

const QuadMesh& sheet() {
  static const QuadMesh mesh = square_sheet(6);
  return mesh;
}

/// Fine cotton held by the upper edge, which moves.
ClothModel held_model(const Motion& motion) {
  ClothModel model = sheet_model(sheet(), library_fabric("fine cotton"));
  model.gravity = {0, -9.81, 0};
  for (int i = 0; i <= 6; ++i)
    model.pins.push_back({VertexId(i), sheet().rest_positions().col(i), motion});
  return model;
}

State tossed_state() {
  Random random(1);
  State state = rest_state(sheet());
  state.velocities = shaken(state.velocities, 1, random);
  return state;
}

State advanced(ClothModel& model, const MethodOptions& options, State state, int n_steps) {
  const auto stepper = make_stepper(model, options);
  for (int s = 0; s < n_steps; ++s) REQUIRE(stepper->advance(state, s * options.step).ok());
  return state;
}

void shuffle(std::vector<Spring>& springs, Random& random) {
  for (std::size_t s = springs.size(); s > 1; --s)
    std::swap(springs[s - 1],
              springs[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(s)))]);
}

}  // namespace

TEST_CASE("steppers: pinned vertices end exactly at their pins", "[dynamics]") {
  const Motion motion{Motion::Kind::ease, {0.1, -0.05, 0.2}, 0, 0.4, 0};
  for (const MethodOptions& options : everyday_methods()) {
    CAPTURE(options.stepper->name);
    ClothModel model = held_model(motion);
    const State end = advanced(model, options, tossed_state(), 15);
    for (const Pin& pin : model.pins)
      CHECK(end.positions.col(pin.vertex.value) == pin.position(15 * options.step));
  }
}

TEST_CASE("steppers: pinned vertices have the speed of their pins", "[dynamics]") {
  const Motion motion{Motion::Kind::move, {0.3, -0.1, 0.2}, 0, 1, 0};
  for (const MethodOptions& options : everyday_methods()) {
    CAPTURE(options.stepper->name);
    ClothModel model = held_model(motion);
    const State end = advanced(model, options, tossed_state(), 15);
    for (const Pin& pin : model.pins)
      CHECK((end.velocities.col(pin.vertex.value) - motion.offset).norm() < 1e-10);
  }
}

// The chord of a substep, which some steppers take as the velocity, is turned by omega h/2 from it.
TEST_CASE("steppers: pinned vertices go round with their pins, then rest", "[dynamics]") {
  Motion motion;
  motion.kind = Motion::Kind::turn;
  motion.centre = {0.1, 0.2, 0.3};
  motion.axis = Vec3(2, 1, -2) / 3;
  motion.rate = 2;
  motion.time_end = 1;
  for (const MethodOptions& options : everyday_methods()) {
    CAPTURE(options.stepper->name);
    ClothModel model = held_model(motion);
    const State end = advanced(model, options, tossed_state(), 15);
    const double time = 15 * options.step;
    for (const Pin& pin : model.pins) {
      const Vec3 arm = pin.position(time) - motion.centre;
      CHECK(end.positions.col(pin.vertex.value) == pin.position(time));
      CHECK((arm.norm() - (pin.place - motion.centre).norm()) == Approx(0).margin(1e-14));
      const Vec3 around = motion.rate * motion.axis.cross(arm);
      const Vec3 velocity = end.velocities.col(pin.vertex.value);
      CHECK((velocity - around).norm() < motion.rate * options.step * around.norm());
    }
  }
}

TEST_CASE("steppers: a flat sheet without weight stays where it is to rounding", "[dynamics]") {
  for (const MethodOptions& options : everyday_methods()) {
    CAPTURE(options.stepper->name);
    ClothModel model = sheet_model(sheet(), library_fabric("fine cotton"));
    const State start = rest_state(sheet());
    const State end = advanced(model, options, start, 60);
    // Lengths round: a spring's rest length is the square root of a sum. xpbd rounds to float32.
    const double rounding = options.stepper->is_single_precision ? 1e-4 : 1e-8;
    CHECK((end.positions - start.positions).cwiseAbs().maxCoeff() < rounding);
    CHECK(end.velocities.cwiseAbs().maxCoeff() < rounding);
  }
}

TEST_CASE("steppers: a sheet that hangs at rest stays so in any order of its springs",
          "[dynamics][long]") {
  const auto seed = GENERATE(1u, 2u);
  CAPTURE(seed);
  Random random(seed);
  ClothModel model = held_model({});
  for (Spring& spring : model.springs) spring.damping *= 20;  // settles sooner
  shuffle(model.springs, random);
  MethodOptions settle = everyday_methods()[1];
  settle.solver = SolverKind::eigen;
  State hanging = advanced(model, settle, rest_state(sheet()), 600);
  REQUIRE(hanging.velocities.cwiseAbs().maxCoeff() < 1e-9);
  for (MethodOptions options : everyday_methods()) {
    if (options.stepper->is_single_precision) continue;  // xpbd_test.cpp has its own
    CAPTURE(options.stepper->name);
    options.tolerance = 1e-10;
    // 10 s; explicit, which takes hundreds of substeps, 1 s.
    const int n_steps = options.stepper == &steppers::kExplicitEuler ? 60 : 600;
    const State end = advanced(model, options, hanging, n_steps);
    CHECK((end.positions - hanging.positions).cwiseAbs().maxCoeff() < 1e-7);
    CHECK(end.velocities.cwiseAbs().maxCoeff() < 1e-7);
    const State later = advanced(model, options, end, n_steps);
    CHECK((later.positions - end.positions).cwiseAbs().maxCoeff() < 1e-7);
  }
}

TEST_CASE("steppers: the same start gives the same bits", "[dynamics]") {
  const Motion motion{Motion::Kind::oscillate, {0.1, 0, 0.1}, 0, 0, 2};
  for (const MethodOptions& options : everyday_methods()) {
    CAPTURE(options.stepper->name);
    ClothModel model = held_model(motion);
    model.air.emplace(sheet().triangles(), AirOptions{}, model.n_vertices());
    const State first = advanced(model, options, tossed_state(), 20);
    const State second = advanced(model, options, tossed_state(), 20);
    CHECK(first.positions == second.positions);
    CHECK(first.velocities == second.velocities);
  }
}

TEST_CASE("steppers: rest lengths may change between steps", "[dynamics]") {
  for (const MethodOptions& options : everyday_methods()) {
    CAPTURE(options.stepper->name);
    ClothModel model = held_model({});
    const auto stepper = make_stepper(model, options);
    for (Spring& spring : model.springs) spring.rest_length *= 1.01;
    stepper->refresh_rest_lengths();
    State refreshed = tossed_state();
    stepper->advance(refreshed, 0);
    const State built_anew = advanced(model, options, tossed_state(), 1);
    CHECK(refreshed.positions == built_anew.positions);
    ClothModel other = held_model({});
    CHECK(refreshed.positions != advanced(other, options, tossed_state(), 1).positions);
  }
}

TEST_CASE("steppers: a state that is not finite ends the step and is named", "[dynamics]") {
  const double bad =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  const bool in_position = GENERATE(true, false);
  CAPTURE(bad, in_position);
  for (const MethodOptions& options : everyday_methods()) {
    CAPTURE(options.stepper->name);
    ClothModel model;  // free vertices, so that the bad one stays alone
    model.masses = Eigen::VectorXd::Ones(5);
    State state{Positions::Random(3, 5), Positions::Zero(3, 5)};
    (in_position ? state.positions : state.velocities)(1, 3) = bad;
    const SolveReport report = make_stepper(model, options)->advance(state, 0);
    CHECK(report.status == SolveStatus::not_finite);
    CAPTURE(report.message);
    CHECK(report.message.find("vertex 3") != std::string::npos);
  }
}

TEST_CASE("steppers: cloth that flies further than any cloth has diverged", "[dynamics]") {
  for (const MethodOptions& options : everyday_methods()) {
    CAPTURE(options.stepper->name);
    ClothModel model = held_model({});
    State state = tossed_state();
    state.velocities.col(17) *= 1e15;
    const State start = state;
    const SolveReport report = make_stepper(model, options)->advance(state, 1.5);
    CHECK(report.status == SolveStatus::not_finite);
    CHECK(report.message.find("vertex 17 ") == 0);
    CHECK(report.message.find("from 1.5 s") != std::string::npos);
    CHECK(state.positions == start.positions);
  }
}

TEST_CASE("steppers: a step that overflows leaves the last finite state", "[dynamics]") {
  for (const MethodOptions& options : everyday_methods()) {
    CAPTURE(options.stepper->name);
    ClothModel model;
    model.masses = Eigen::VectorXd::Ones(2);
    State state{Positions::Zero(3, 2), Positions::Zero(3, 2)};
    state.positions(0, 0) = std::numeric_limits<double>::max();
    state.velocities(0, 0) = std::numeric_limits<double>::max();
    const State before = state;
    const SolveReport report = make_stepper(model, options)->advance(state, 0);
    CHECK(report.status == SolveStatus::not_finite);
    CHECK(state.positions == before.positions);
    CHECK(state.velocities == before.velocities);
  }
}

TEST_CASE("steppers: nothing is allocated per step after the first two", "[dynamics]") {
  if (!counts_allocations()) return;
  const bool with_air = GENERATE(false, true);
  const bool with_contact = GENERATE(false, true);
  const bool is_membrane = GENERATE(false, true);
  CAPTURE(with_air, with_contact, is_membrane);
  std::vector<MethodOptions> methods = everyday_methods();
  for (const MethodOptions& options : accurate_methods(1.0 / 240)) methods.push_back(options);
  for (MethodOptions options : methods) {
    CAPTURE(options.stepper->name);
    if (options.stepper == &steppers::kProjective || options.stepper == &steppers::kNewton) {
      if (!is_available(SolverKind::cholmod)) continue;  // Eigen's factorisation allocates
      options.solver = SolverKind::cholmod;
    }
    ClothModel model = held_model({});
    if (is_membrane) {
      const std::vector<Pin> pins = model.pins;
      model = membrane_model(sheet(), library_fabric("fine cotton"));
      model.pins = pins;
      if (options.stepper->needs_springs) continue;
    }
    if (with_air) model.air.emplace(sheet().triangles(), AirOptions{}, model.n_vertices());
    if (with_contact) {
      const Collider floor{Plane{{0, -1.01, 0}, {0, 1, 0}}, {}, 0.3};
      model.contact.emplace(std::vector<Collider>{floor}, ContactOptions{});
    }
    // A factorisation that newton finds impossible, in crumpled cloth, is told in a message.
    State state = options.stepper == &steppers::kNewton ? rest_state(sheet()) : tossed_state();
    const auto stepper = make_stepper(model, options);
    stepper->advance(state, 0);
    // The floor is met, for which projective makes its factor anew.
    stepper->advance(state, options.step);
    CHECK(allocations_in([&] {
            for (int s = 2; s < 6; ++s) stepper->advance(state, s * options.step);
          }) == 0);
  }
}

TEST_CASE("steppers: settings outside their range are refused", "[dynamics]") {
  ClothModel model = held_model({});
  MethodOptions options;
  SECTION("step") { options.step = 0; }
  SECTION("substeps") { options.substeps = 0; }
  SECTION("iterations") { options.iterations = 0; }
  SECTION("tolerance") { options.tolerance = 1; }
  CHECK_THROWS_AS(make_stepper(model, options), ContractError);
}

}  // namespace pleat
