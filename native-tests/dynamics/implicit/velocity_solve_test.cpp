#include "core/dynamics/implicit/velocity_solve.h"
#include "core/linalg/make_linear_solver.h"

#include <catch2/catch.hpp>
#include <vector>

#include "native-tests/support/graded_sheets.h"
#include "native-tests/support/models.h"

using namespace pleat;

namespace {

constexpr int kCells = 5;
constexpr int kVertices = (kCells + 1) * (kCells + 1);

/// Iterations of a solver for one substep after another whose velocity changes are `change(step)`.
std::vector<int> iterations(int n_steps, const std::function<Positions(int)>& change) {
  constexpr double kTolerance = 1e-6;
  const QuadMesh mesh = square_sheet(kCells);
  const ClothModel model = sheet_model(mesh, library_fabric("fine cotton"));
  VelocitySolve solve(model, SolverKind::cg,
                      make_linear_solver(SolverKind::cg, {kTolerance, 1000}));
  SystemMatrix matrix(model);
  solve.analyze(matrix);
  solve.choose_pins(matrix);
  const Positions rest = Positions::Zero(3, model.n_vertices());
  const Positions& places = mesh.rest_positions();
  std::vector<int> counts;
  for (int step = 0; step < n_steps; ++step) {
    matrix.set_zero();
    matrix.add_masses(1);
    matrix.add_elasticity(places, 1e-4, 0, ElementHessian::projected);
    const Positions wanted = change(step);
    Positions rhs(3, model.n_vertices());
    flat(rhs) = matrix.lower().selfadjointView<Eigen::Lower>() * flat(wanted);
    State state{rest, rest};
    const SolveReport report = solve.advance(matrix, rhs, state, 0, 1, nullptr);
    REQUIRE(report.ok());
    CHECK((state.velocities - wanted).norm() < 1e-3 * wanted.norm());
    CHECK(state.positions == state.velocities);
    counts.push_back(report.iterations);
  }
  return counts;
}

}  // namespace

TEST_CASE("velocity solve: a polynomial of time is known before it is solved", "[dynamics]") {
  Random random(4);
  const Positions none = Positions::Zero(3, kVertices);
  const Positions parts[] = {shaken(none, 1, random), shaken(none, 1, random),
                             shaken(none, 1, random)};
  const auto counts = iterations(8, [&](int step) -> Positions {
    const double t = 0.3 * step;
    return parts[0] + t * parts[1] + t * t * parts[2];
  });
  CHECK(counts.front() > 3);
  CHECK(counts.back() <= 1);
}

TEST_CASE("velocity solve: what cg leaves has no sum over free vertices, beside pins and holds too",
          "[dynamics]") {
  const QuadMesh mesh = graded_sheet(3);
  ClothModel model = sheet_model(mesh, library_fabric("fine cotton"));
  const int n_pins = GENERATE(0, 1, 3);
  const bool has_holds = GENERATE(false, true);
  for (int p = 0; p < n_pins; ++p)
    model.pins.push_back({VertexId(p), mesh.rest_positions().col(p) + Vec3(0, 0, 0.1), {}});
  VelocitySolve solve(model, SolverKind::cg, make_linear_solver(SolverKind::cg, {0.1, 1000}));
  SystemMatrix matrix(model);
  solve.analyze(matrix);
  solve.choose_pins(matrix);
  matrix.set_zero();
  matrix.add_masses(1);
  matrix.add_elasticity(mesh.rest_positions(), 1e-4, 0, ElementHessian::projected);
  Random random(5);
  Positions rhs = shaken(Positions::Zero(3, model.n_vertices()), 1, random);
  matrix.reduce_to_parents(flat(rhs));
  if (has_holds)
    matrix.add_diagonal(VertexId(4), matrix.diagonal_trace(VertexId(4)) * Mat3::Identity());
  State state = rest_state(mesh);
  REQUIRE(solve.advance(matrix, rhs, state, 0, 1, nullptr).ok());
  Positions left = rhs;
  flat(left) -= matrix.lower().selfadjointView<Eigen::Lower>() * flat(state.velocities);
  for (const Pin& pin : model.pins) left.col(pin.vertex).setZero();
  for (const HangingVertex& hanging : model.hanging) left.col(hanging.vertex).setZero();
  CHECK(left.norm() > 0.01 * rhs.norm());
  CHECK(left.rowwise().sum().norm() < 1e-10 * left.norm());
}

TEST_CASE("velocity solve: where cg gives up a factor solves, and cg is tried again",
          "[dynamics]") {
  constexpr int kMostIterations = 2;
  const QuadMesh mesh = square_sheet(kCells);
  const ClothModel model = sheet_model(mesh, library_fabric("fine cotton"));
  VelocitySolve solve(model, SolverKind::cg,
                      make_linear_solver(SolverKind::cg, {1e-9, kMostIterations}));
  SystemMatrix matrix(model);
  solve.analyze(matrix);
  solve.choose_pins(matrix);
  matrix.set_zero();
  matrix.add_masses(1);
  matrix.add_elasticity(mesh.rest_positions(), 1e-4, 0, ElementHessian::projected);
  Random random(6);
  const Positions rest = Positions::Zero(3, model.n_vertices());
  for (int step = 0; step < 40; ++step) {
    CAPTURE(step);
    const Positions wanted = shaken(rest, 1, random);
    Positions rhs(3, model.n_vertices());
    flat(rhs) = matrix.lower().selfadjointView<Eigen::Lower>() * flat(wanted);
    State state{rest, rest};
    const SolveReport report = solve.advance(matrix, rhs, state, 0, 1, nullptr);
    CHECK(report.ok());
    CHECK_FALSE(report.message.empty());
    CHECK(report.iterations == (step % 16 == 0 ? kMostIterations : 0));
    CHECK((state.velocities - wanted).norm() < 1e-9 * wanted.norm());
  }
}

TEST_CASE("velocity solve: where the factor fails too, what cg came to is reported", "[dynamics]") {
  const QuadMesh mesh = square_sheet(kCells);
  const ClothModel model = sheet_model(mesh, library_fabric("fine cotton"));
  VelocitySolve solve(model, SolverKind::cg, make_linear_solver(SolverKind::cg, {1e-9, 100}));
  SystemMatrix matrix(model);
  solve.analyze(matrix);
  solve.choose_pins(matrix);
  matrix.set_zero();
  matrix.add_masses(-1);
  State state = rest_state(mesh);
  Positions rhs = Positions::Ones(3, model.n_vertices());
  const SolveReport report = solve.advance(matrix, rhs, state, 0, 1, nullptr);
  CHECK(report.status == SolveStatus::not_positive_definite);
  CHECK(state.velocities.isZero(0));
}

TEST_CASE("velocity solve: after chance the last change is the first guess", "[dynamics]") {
  Random random(4);
  const Positions none = Positions::Zero(3, kVertices);
  const Positions at_last = shaken(none, 1, random);
  const auto counts = iterations(
      12, [&](int step) -> Positions { return step < 9 ? shaken(none, 1, random) : at_last; });
  CHECK(counts[9] > 3);
  CHECK(counts[10] == 0);
}
