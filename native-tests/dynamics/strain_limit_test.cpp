#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/dynamics/stepper_table.h"
#include "core/dynamics/strain_limit_pass.h"
#include "core/model/hanging_vertices.h"
#include "core/model/momentum.h"
#include "native-tests/support/graded_sheets.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr double kDisplayStep = 1.0 / 60;

ClothModel limited(ClothModel model, const QuadMesh& mesh, const StrainLimitOptions& options = {}) {
  model.strain_limit = StrainLimit{options, in_lines(gauge_edges(mesh), mesh.rest_positions())};
  return model;
}

/// A free sheet whose vertices fly apart in all directions.
State bursting_state(const QuadMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  State state = rest_state(mesh);
  state.velocities = shaken(state.velocities, 4, random);
  return state;
}

/// The end of a substep in which nothing acts on the vertices.
State drifted(const State& begin, double h) {
  return {begin.positions + h * begin.velocities, begin.velocities};
}

double longest_share(const QuadMesh& mesh, const Positions& positions) {
  double longest = 0;
  for (const GaugeEdge& edge : gauge_edges(mesh))
    longest = std::max(longest,
                       (positions.col(edge.a) - positions.col(edge.b)).norm() / edge.rest_length);
  return longest;
}

/// Two vertices 1 m apart that fly apart along x.
struct Pair {
  ClothModel model;
  State begin{Positions::Zero(3, 2), Positions::Zero(3, 2)};

  explicit Pair(const StrainLimitOptions& options) {
    model.masses = Eigen::Vector2d(1, 3);
    model.gravity.setZero();
    model.strain_limit = StrainLimit{options, {{VertexId(0), VertexId(1), 1.0}}};
    begin.positions(0, 1) = 1;
    begin.velocities(0, 1) = 6;
  }
};

/// Soft enough to hang twice as long as it is.
Chain soft_chain() {
  Chain chain;
  chain.stiffness = 15;
  chain.relaxation = 0.01;
  return chain;
}

std::vector<GaugeEdge> edges_of(const ClothModel& model) {
  std::vector<GaugeEdge> edges;
  for (const Spring& spring : model.springs)
    edges.push_back({spring.a, spring.b, spring.rest_length});
  return edges;
}

}  // namespace

TEST_CASE("strain limit: two masses that fly apart end at the limit as an inelastic pull has it",
          "[dynamics]") {
  StrainLimitOptions options;
  options.stretch = 0.1;
  const Pair pair(options);
  StrainLimitPass pass(pair.model);
  State state = drifted(pair.begin, 0.1);  // 1.6 m long
  pass.limit(state, 0.1);
  const double goal = 1.099;  // a hundredth of the limit below it
  const double pulled = 1.6 - goal;
  CHECK(state.positions(0, 0) == Approx(0.75 * pulled));
  CHECK(state.positions(0, 1) == Approx(1.6 - 0.25 * pulled));
  CHECK(state.velocities(0, 0) == Approx(0.75 * pulled / 0.1));
  CHECK(state.velocities(0, 1) == Approx(6 - 0.25 * pulled / 0.1));
  CHECK(pass.n_capped() == 0);
}

TEST_CASE("strain limit: Provot's moves places alone", "[dynamics]") {
  StrainLimitOptions options;
  options.law = StrainLimitLaw::provot;
  const Pair pair(options);
  StrainLimitPass pass(pair.model);
  State state = drifted(pair.begin, 0.1);
  pass.limit(state, 0.1);
  CHECK(state.positions(0, 1) - state.positions(0, 0) == Approx(1.099));
  CHECK(state.velocities == pair.begin.velocities);
}

TEST_CASE("strain limit: an edge is not compressed beyond its lower limit", "[dynamics]") {
  StrainLimitOptions options;
  options.compression = GENERATE(0.2, 1.0);
  Pair pair(options);
  pair.begin.velocities(0, 1) = -6;
  StrainLimitPass pass(pair.model);
  State state = drifted(pair.begin, 0.1);  // 0.4 m long
  pass.limit(state, 0.1);
  const double goal = options.compression < 1 ? 0.802 : 0.4;
  CHECK(state.positions(0, 1) - state.positions(0, 0) == Approx(goal));
}

TEST_CASE("strain limit: sweeps end below the limit and keep the momentum", "[dynamics]") {
  const auto seed = GENERATE(range<std::uint64_t>(1, 6));
  const QuadMesh mesh = GENERATE_COPY(square_sheet(6), graded_sheet(seed));
  StrainLimitOptions options;
  options.stretch = GENERATE(0.02, 0.1);
  options.max_sweeps = 5000;
  const ClothModel model = limited(sheet_model(mesh, soft_fabric()), mesh, options);
  State begin = bursting_state(mesh, seed);
  place_between_parents(model.hanging, begin);
  const State proposed = drifted(begin, 0.003);
  REQUIRE(longest_share(mesh, proposed.positions) > 1 + 1.05 * options.stretch);
  StrainLimitPass pass(model);
  State state = proposed;
  pass.limit(state, 0.003);
  place_between_parents(model.hanging, state);
  CAPTURE(seed, mesh.n_vertices(), pass.n_sweeps());
  CHECK(longest_share(mesh, state.positions) <= 1 + options.stretch);
  CHECK(pass.n_capped() == 0);
  const double momentum_scale = model.masses.sum() * 4;
  CHECK((momentum(model, state) - momentum(model, proposed)).norm() < 1e-13 * momentum_scale);
}

TEST_CASE(
    "strain limit: what two turning masses lose of their angular momentum falls with the step",
    "[dynamics]") {
  const auto lost = [](double h) {
    Pair pair({});
    pair.begin.positions(0, 1) = 1.099;
    pair.begin.velocities.setZero();
    pair.begin.velocities(1, 1) = 3;  // moves across
    StrainLimitPass pass(pair.model);
    State state = pair.begin;
    const double before = angular_momentum(pair.model, state).norm();
    for (int s = 0; s < std::lround(0.5 / h); ++s) {
      state = drifted(state, h);
      pass.limit(state, h);
    }
    return 1 - angular_momentum(pair.model, state).norm() / before;
  };
  const double coarse = lost(0.002);
  const double fine = lost(0.001);
  CAPTURE(coarse, fine);
  CHECK(std::log2(coarse / fine) == Approx(1).margin(0.1));
  CHECK(fine < 0.01);
}

TEST_CASE("strain limit: lines go straight on, each edge is in one", "[dynamics]") {
  const QuadMesh mesh = square_sheet(5);
  const std::vector<GaugeEdge> plain = gauge_edges(mesh);
  const std::vector<GaugeEdge> edges = in_lines(plain, mesh.rest_positions());
  REQUIRE(edges.size() == plain.size());
  int n_lines = 1;
  for (std::size_t e = 1; e < edges.size(); ++e)
    if (edges[e].a != edges[e - 1].b) ++n_lines;
  CHECK(n_lines == 12);
}

TEST_CASE("strain limit: a soft chain comes to rest at its limits with every stepper",
          "[dynamics]") {
  ClothModel model = chain_model(soft_chain());
  StrainLimitOptions options;
  options.stretch = 0.1;
  model.strain_limit = StrainLimit{options, edges_of(model)};
  for (const MethodOptions& method : everyday_methods()) {
    CAPTURE(method.stepper->name);
    State state = {hanging_state(soft_chain()).positions, Positions::Zero(3, model.n_vertices())};
    state.positions *= model.n_vertices() > 0 ? 0.5 : 1;
    const auto stepper = make_stepper(model, method);
    for (int s = 0; s < 600; ++s) {
      const SolveReport report = stepper->advance(state, s * method.step);
      CAPTURE(s, report.message, stepper->substeps(), state.positions);
      REQUIRE(report.ok());
    }
    const auto rested = stretch(edges_of(model), state.positions);
    CHECK(rested.largest <= 0.1 * (1 + 1e-4));
    CHECK(rested.largest > 0.095);
    CHECK(state.velocities.colwise().norm().maxCoeff() < 0.01);
    CHECK(stepper->strain_limit()->n_capped() == 0);
  }
}

TEST_CASE("strain limit: cloth that hangs at its limits takes few sweeps", "[dynamics]") {
  ClothModel model = chain_model(soft_chain());
  model.strain_limit = StrainLimit{{}, edges_of(model)};
  State state = {hanging_state(soft_chain()).positions * 0.5,
                 Positions::Zero(3, model.n_vertices())};
  const auto stepper = make_stepper(model, steppers::kImplicitEuler.usual_method());
  std::int64_t n_sweeps = 0;
  for (int s = 0; s < 300; ++s) {
    if (s == 200) n_sweeps = stepper->strain_limit()->n_sweeps();
    REQUIRE(stepper->advance(state, s * kDisplayStep).ok());
  }
  CHECK(stepper->strain_limit()->n_sweeps() - n_sweeps <= 4 * 100);
}

TEST_CASE("strain limit: out of reach it changes no bit", "[dynamics]") {
  const QuadMesh mesh = square_sheet(4);
  StrainLimitOptions options;
  options.stretch = 100;
  ClothModel plain = sheet_model(mesh, soft_fabric());
  plain.gravity = {0, -9.81, 0};
  plain.pins = {{VertexId(0), mesh.rest_positions().col(0), {}}};
  ClothModel with = limited(plain, mesh, options);
  for (const MethodOptions& method : everyday_methods()) {
    CAPTURE(method.stepper->name);
    State a = rest_state(mesh);
    State b = a;
    const auto one = make_stepper(plain, method);
    const auto other = make_stepper(with, method);
    for (int s = 0; s < 20; ++s) {
      one->advance(a, s * kDisplayStep);
      other->advance(b, s * kDisplayStep);
    }
    if (method.stepper->is_single_precision)  // it rounds anew what it hands over
      CHECK((a.positions - b.positions).norm() < 1e-4);
    else
      CHECK(a.positions == b.positions);
    CHECK(other->strain_limit()->n_sweeps() > 0);
  }
}

TEST_CASE("strain limit: pins that pull too far are told of, and the cloth recovers",
          "[dynamics]") {
  const QuadMesh mesh = square_sheet(4);
  ClothModel model = limited(sheet_model(mesh, soft_fabric()), mesh);
  model.gravity = {0, -9.81, 0};
  for (const int v : {0, 24}) model.pins.push_back({VertexId(v), mesh.rest_positions().col(v), {}});
  Motion apart;
  apart.kind = Motion::Kind::oscillate;
  apart.offset = {0, -3, 0};
  apart.frequency = 0.5;
  model.pins[1].motion = apart;
  for (const MethodOptions& method : everyday_methods()) {
    CAPTURE(method.stepper->name);
    State state = rest_state(mesh);
    const auto stepper = make_stepper(model, method);
    std::int64_t n_capped = 0;
    for (int s = 0; s < 120; ++s) {  // there and back
      REQUIRE(stepper->advance(state, s * kDisplayStep).status != SolveStatus::not_finite);
      if (s == 40) n_capped = stepper->strain_limit()->n_capped();
    }
    CHECK(n_capped > 0);
    CHECK(state.velocities.colwise().norm().maxCoeff() < 60);
    CHECK(longest_share(mesh, state.positions) < 1.5);
  }
}

TEST_CASE("strain limit: cloth pulled over a ball stays out of it and below its limit",
          "[dynamics]") {
  const QuadMesh mesh = lying_sheet(12);
  StrainLimitOptions options;
  options.stretch = 0.05;
  ClothModel model = limited(sheet_model(mesh, soft_fabric()), mesh, options);
  model.gravity = {0, 0, -9.81};
  Collider ball;
  ball.shape = Sphere{{0.5, 0.5, -0.305}, 0.3};
  ball.friction = 0.3;
  for (MethodOptions method : everyday_methods()) {
    CAPTURE(method.stepper->name);
    model.contact.emplace(std::vector<Collider>{ball}, ContactOptions{0.001, {}, {}});
    State state = rest_state(mesh);
    const auto stepper = make_stepper(model, method);
    double largest = 0;
    for (int s = 0; s < 90; ++s) {
      REQUIRE(stepper->advance(state, s * kDisplayStep).status != SolveStatus::not_finite);
      CHECK(model.contact->penetration(state.positions, (s + 1) * kDisplayStep).depth < 1e-9);
      largest = std::max(largest, longest_share(mesh, state.positions));
    }
    CHECK(largest <= 1 + options.stretch * 1.02);
  }
}

TEST_CASE("strain limit: options that mean nothing are refused", "[dynamics]") {
  StrainLimitOptions options;
  SECTION("no stretch") { options.stretch = 0; }
  SECTION("no compression") { options.compression = 0; }
  SECTION("through itself") { options.compression = 1.1; }
  SECTION("no sweep") { options.max_sweeps = 0; }
  CHECK_THROWS_AS(options.validate(), ContractError);
}

}  // namespace pleat
