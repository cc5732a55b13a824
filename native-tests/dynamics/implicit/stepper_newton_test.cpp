#include "core/dynamics/implicit/stepper_newton.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/dynamics/stepper_table.h"
#include "core/model/elasticity.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

MethodOptions newton(NewtonRule rule, double step) {
  MethodOptions options;
  options.stepper = &steppers::kNewton;
  options.rule = rule;
  options.step = step;
  options.solver = SolverKind::eigen;
  options.tolerance = kNewtonTolerance;
  return options;
}

/// A sheet of linen held by two corners that flies at 2 m/s, strained and shaken.
struct HardProblem {
  QuadMesh mesh = square_sheet(6);
  ClothModel model = sheet_model(mesh, library_fabric("linen"));
  State start = rest_state(mesh);

  HardProblem() {
    Random random(11);
    model.gravity = {0, -9.81, 0};
    start.positions = shaken(start.positions, 0.004, random);
    start.velocities = shaken(start.velocities, 2, random);
    for (const int corner : {0, 6})
      model.pins.push_back({VertexId(corner), start.positions.col(corner), {}});
  }
};

/// |M (v1 - v0)/h - f(x, v)| over the free vertices, of |f|.
double residual(const ClothModel& model, const State& begin, const State& end, double h,
                const State& where) {
  Positions forces = Positions::Zero(3, model.n_vertices());
  add_elastic_forces(model, where.positions, forces);
  add_gravity(model, forces);
  Positions inertia = (end.velocities - begin.velocities) / h * model.masses.asDiagonal();
  for (const Pin& pin : model.pins) {
    forces.col(pin.vertex).setZero();
    inertia.col(pin.vertex).setZero();
  }
  return (inertia - forces).norm() / forces.norm();
}

/// Positions of nodes of the inextensible limit are not needed: a rope of springs between two pins.
ClothModel rope_model(int n_springs, double span, double length, double stiffness) {
  ClothModel model;
  model.masses = Eigen::VectorXd::Constant(n_springs + 1, 0.1 / n_springs);
  for (int i = 0; i < n_springs; ++i)
    model.springs.push_back({VertexId(i), VertexId(i + 1), stiffness * n_springs,
                             length / n_springs, 0, SpringKind::other});
  model.pins.push_back({VertexId(0), Vec3(0, 0, 0), {}});
  model.pins.push_back({VertexId(n_springs), Vec3(span, 0, 0), {}});
  return model;
}

}  // namespace

TEST_CASE("newton: the step's own equations hold to rounding", "[dynamics]") {
  HardProblem problem;
  for (Spring& spring : problem.model.springs) spring.damping = 0;
  const double h = GENERATE(1.0 / 600, 1.0 / 60);
  State end = problem.start;
  SECTION("backward Euler") {
    const auto stepper = make_stepper(problem.model, newton(NewtonRule::backward_euler, h));
    const SolveReport report = stepper->advance(end, 0);
    REQUIRE(report.ok());
    CHECK(report.relative_residual < 1e-10);
    CHECK((end.positions - problem.start.positions - h * end.velocities).norm() < 1e-12);
    CHECK(residual(problem.model, problem.start, end, h, end) < 1e-9);
  }
  SECTION("midpoint") {
    const auto stepper = make_stepper(problem.model, newton(NewtonRule::midpoint, h));
    REQUIRE(stepper->advance(end, 0).ok());
    const State middle{(problem.start.positions + end.positions) / 2, end.velocities};
    CHECK(residual(problem.model, problem.start, end, h, middle) < 1e-9);
  }
}

TEST_CASE("newton: converges quadratically", "[dynamics]") {
  HardProblem problem;
  problem.start.positions *= 1.05;  // puts it in tension, where the true Hessian serves throughout
  for (Pin& pin : problem.model.pins) pin.place *= 1.05;
  const auto after = [&](double tolerance, int& iterations) {
    MethodOptions options = newton(NewtonRule::backward_euler, 1.0 / 120);
    options.tolerance = tolerance;
    State state = problem.start;
    const auto stepper = make_stepper(problem.model, options);
    iterations = stepper->advance(state, 0).iterations;
    return state.positions;
  };
  int last = 0;
  const Positions exact = after(1e-13, last);
  // One more iteration for every looser tolerance that asks for it.
  std::vector<double> errors;
  int known = 0;
  for (double tolerance = 0.5; tolerance > 1e-12 && known < last; tolerance /= 1.5) {
    int iterations = 0;
    const double error = (after(tolerance, iterations) - exact).norm();
    // Smaller errors are those of the linear solves.
    if (iterations > known && error > 1e-9) errors.push_back(error);
    known = std::max(known, iterations);
  }
  REQUIRE(errors.size() >= 3);
  CAPTURE(errors);
  // e_{k+1} = c e_k^2: the logarithms' differences double.
  const std::size_t n = errors.size();
  const double before = std::log(errors[n - 2] / errors[n - 3]);
  const double after_it = std::log(errors[n - 1] / errors[n - 2]);
  CHECK(after_it / before > 1.7);
}

TEST_CASE("newton: a compressed sheet buckles without a failure", "[dynamics]") {
  // The true Hessian of a flat sheet under compression is indefinite.
  HardProblem problem;
  problem.model.pins.clear();
  problem.start = rest_state(problem.mesh);
  problem.start.positions *= 0.9;
  problem.start.positions(2, 24) += 1e-4;
  const auto stepper = make_stepper(problem.model, newton(NewtonRule::backward_euler, 1.0 / 60));
  double energy = total_energy(problem.model, problem.start);
  for (int s = 0; s < 10; ++s) {
    REQUIRE(stepper->advance(problem.start, s / 60.0).ok());
    const double next = total_energy(problem.model, problem.start);
    CHECK(next < energy);
    energy = next;
  }
}

TEST_CASE("newton: midpoint keeps the energy of a spring and backward Euler loses it",
          "[dynamics]") {
  ClothModel model;
  model.masses = Eigen::VectorXd::Constant(2, 0.1);
  model.gravity.setZero();
  model.springs.push_back({VertexId(0), VertexId(1), 50, 0.2, 0, SpringKind::other});
  State start{Positions::Zero(3, 2), Positions::Zero(3, 2)};
  start.positions(0, 1) = 0.25;
  const auto kept = [&](NewtonRule rule) {
    State state = start;
    const auto stepper = make_stepper(model, newton(rule, 0.01));
    for (int s = 0; s < 1000; ++s) REQUIRE(stepper->advance(state, s * 0.01).ok());
    return total_energy(model, state) / total_energy(model, start);
  };
  CHECK(kept(NewtonRule::midpoint) == Approx(1).epsilon(1e-9));
  CHECK(kept(NewtonRule::backward_euler) < 0.1);
}

TEST_CASE("newton: equilibrium finds the hanging chain from any start", "[dynamics]") {
  const Chain chain;
  ClothModel model = chain_model(chain);
  const State expected = hanging_state(chain);
  const double tilt = GENERATE(0.0, 1.5, 3.0);  // [rad] from straight down
  State state = expected;
  for (int i = 0; i <= chain.n_springs; ++i)
    state.positions.col(i) =
        chain.length * i * Vec3(std::sin(tilt), -std::cos(tilt), 0.01 * std::sin(i));
  const auto stepper = make_stepper(model, newton(NewtonRule::equilibrium, 1));
  const SolveReport report = stepper->advance(state, 0);
  CAPTURE(tilt, report.message, report.iterations);
  REQUIRE(report.ok());
  CHECK((state.positions - expected.positions).norm() < 1e-8);
  CHECK(state.velocities.isZero(0));
}

TEST_CASE("newton: a rope of springs hangs in a catenary, with second order", "[dynamics]") {
  // Inextensible rope of length 1.5 over a span of 1: 2 a sinh(1/(2a)) = 1.5, sag a (cosh - 1).
  double a = 0.3;
  for (int i = 0; i < 50; ++i) {
    const double f = 2 * a * std::sinh(0.5 / a) - 1.5;
    const double slope = 2 * std::sinh(0.5 / a) - std::cosh(0.5 / a) / a;
    a -= f / slope;
  }
  const double sag = a * (std::cosh(0.5 / a) - 1);
  std::vector<double> errors;
  for (const int n : {10, 20, 40}) {
    ClothModel model = rope_model(n, 1, 1.5, 1e5);
    State state{Positions::Zero(3, n + 1), Positions::Zero(3, n + 1)};
    for (int i = 0; i <= n; ++i)
      state.positions.col(i) << 1.0 * i / n, -0.5 * std::sin(kPi * i / n), 0;
    const auto stepper = make_stepper(model, newton(NewtonRule::equilibrium, 1));
    const SolveReport report = stepper->advance(state, 0);
    CAPTURE(report.message, report.iterations);
    REQUIRE(report.ok());
    errors.push_back(std::abs(-state.positions.row(1).minCoeff() - sag));
  }
  CAPTURE(errors, sag);
  CHECK(std::log2(errors[0] / errors[1]) == Approx(2).margin(0.2));
  CHECK(std::log2(errors[1] / errors[2]) == Approx(2).margin(0.2));
}

TEST_CASE("newton: equilibrium does not stay on a saddle", "[dynamics]") {
  // A flat sheet pushed together by a fifth, without weight: flat it is at rest, and unstable.
  const QuadMesh mesh = square_sheet(6);
  ClothModel model = sheet_model(mesh, library_fabric("linen"));
  State state = rest_state(mesh);
  for (int i = 0; i < mesh.n_vertices(); ++i) {
    const double v = mesh.rest_coordinates()(1, i);
    if (v > 0 && v < 1) continue;
    state.positions(0, i) += v > 0 ? -0.2 : 0;
    model.pins.push_back({VertexId(i), state.positions.col(i), {}});
  }
  const auto stepper = make_stepper(model, newton(NewtonRule::equilibrium, 1));
  const SolveReport report = stepper->advance(state, 0);
  CAPTURE(report.message, report.iterations);
  REQUIRE(report.ok());
  CHECK(state.positions.row(2).cwiseAbs().maxCoeff() > 0.1);
}

TEST_CASE("newton: vertices in one place fall like others", "[dynamics]") {
  const int n = GENERATE(1, 2);
  ClothModel model;
  model.masses = Eigen::VectorXd::Constant(n, 0.1);
  State state{Positions::Zero(3, n), Positions::Zero(3, n)};
  const auto stepper = make_stepper(model, newton(NewtonRule::midpoint, 0.01));
  for (int s = 0; s < 10; ++s) REQUIRE(stepper->advance(state, s * 0.01).ok());
  CHECK(state.positions(1, 0) == Approx(-0.5 * 9.81 * 0.01));
}

TEST_CASE("steppers: bending by chords is taken by newton, implicit and the explicit ones",
          "[dynamics]") {
  ClothModel model = sheet_model(square_sheet(3), library_fabric("linen"));
  model.chord_bends = {{VertexId(0), VertexId(2), 0.3, 1e-6}};
  for (const StepperType* type : {&steppers::kImplicitEuler, &steppers::kExplicitEuler,
                                  &steppers::kNewton, &steppers::kRk4}) {
    CAPTURE(type->name);
    CHECK_NOTHROW(make_stepper(model, type->usual_method()));
  }
}

TEST_CASE("newton: weight that nothing holds is refused at rest", "[dynamics]") {
  ClothModel model = sheet_model(square_sheet(3), library_fabric("linen"));
  model.gravity = {0, -9.81, 0};
  CHECK_THROWS_AS(make_stepper(model, newton(NewtonRule::equilibrium, 1)), InputError);
}

TEST_CASE("newton: cg leads where a factor leads", "[dynamics]") {
  HardProblem problem;
  MethodOptions options = newton(NewtonRule::backward_euler, 1.0 / 60);
  State expected = problem.start;
  REQUIRE(make_stepper(problem.model, options)->advance(expected, 0).ok());
  options.solver = SolverKind::cg;
  options.preconditioner = GENERATE(Preconditioner::incomplete_factor, Preconditioner::multigrid);
  State found = problem.start;
  REQUIRE(make_stepper(problem.model, options)->advance(found, 0).ok());
  // The last correction is at most 1e-10 of the extent.
  CHECK((found.positions - expected.positions).norm() < 1e-8 * expected.positions.norm());
}

TEST_CASE("newton: takes a direct solver and no solids at rest", "[dynamics]") {
  HardProblem problem;
  MethodOptions options = newton(NewtonRule::equilibrium, 0.01);
  options.solver = SolverKind::cg;
  CHECK_THROWS_AS(make_stepper(problem.model, options), InputError);
  options.solver = SolverKind::sor;
  options.rule = NewtonRule::midpoint;
  CHECK_THROWS_AS(make_stepper(problem.model, options), InputError);
  problem.model.contact.emplace(std::vector<Collider>{Collider{}}, ContactOptions{});
  CHECK_THROWS_AS(make_stepper(problem.model, newton(NewtonRule::equilibrium, 0.01)), InputError);
}

}  // namespace pleat
