#include "core/dynamics/implicit/velocity_solve.h"
#include "core/linalg/make_linear_solver.h"

#include <catch2/catch.hpp>
#include <vector>

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
  VelocitySolve solve(model, make_linear_solver(SolverKind::cg, {kTolerance, 1000}));
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

TEST_CASE("velocity solve: after chance the last change is the first guess", "[dynamics]") {
  Random random(4);
  const Positions none = Positions::Zero(3, kVertices);
  const Positions at_last = shaken(none, 1, random);
  const auto counts = iterations(
      12, [&](int step) -> Positions { return step < 9 ? shaken(none, 1, random) : at_last; });
  CHECK(counts[9] > 3);
  CHECK(counts[10] == 0);
}
