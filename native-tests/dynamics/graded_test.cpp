#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "core/base/check.h"
#include "core/dynamics/explicit/stability_bound.h"
#include "core/dynamics/stepper_table.h"
#include "core/linalg/make_linear_solver.h"
#include "core/model/elasticity.h"
#include "core/model/energy_ledger.h"
#include "core/model/hanging_vertices.h"
#include "core/model/momentum.h"
#include "core/model/system_matrix.h"
#include "core/run/carry_over.h"
#include "native-tests/support/allocation_count.h"
#include "native-tests/support/finite_difference.h"
#include "native-tests/support/graded_sheets.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

/// Settings of every stepper, for steps of `step` [s].
std::vector<MethodOptions> all_methods(double step) {
  std::vector<MethodOptions> methods = converged_methods(step);
  for (const MethodOptions& options : accurate_methods(step)) methods.push_back(options);
  return methods;
}

MethodOptions method(const StepperType* kind, double step) {
  for (const MethodOptions& options : all_methods(step))
    if (options.stepper == kind) return options;
  throw ContractError("a stepper without settings");
}

struct Graded {
  QuadMesh mesh;
  ClothModel model;
  State state;  // stretched, crumpled, drifting and turning
};

Graded graded(std::uint64_t seed) {
  Graded sheet{graded_sheet(seed), {}, {}};
  sheet.model = sheet_model(sheet.mesh, soft_fabric());
  REQUIRE(sheet.model.hanging.size() > 3);
  Random random(seed + 100);
  sheet.state = rest_state(sheet.mesh);
  sheet.state.positions = shaken(1.1 * sheet.state.positions, 0.01, random);
  place_between_parents(sheet.model.hanging, sheet.state.positions);
  for (Eigen::Index i = 0; i < sheet.state.positions.cols(); ++i)
    sheet.state.velocities.col(i) =
        Vec3(1, -2, 0.5) + Vec3(0.5, 1, -2).cross(Vec3(sheet.state.positions.col(i)));
  return sheet;
}

/// Holds one parent of the first hanging vertex and both of the last.
void pin_some_parents(Graded& sheet, const Motion& motion) {
  const auto pin = [&](VertexId v) {
    for (const Pin& held : sheet.model.pins)
      if (held.vertex == v) return;
    sheet.model.pins.push_back({v, sheet.state.positions.col(v), motion});
  };
  pin(sheet.model.hanging.front().parents[0]);
  for (const VertexId parent : sheet.model.hanging.back().parents) pin(parent);
}

State after_steps(ClothModel& model, const MethodOptions& options, State state, int n_steps) {
  const auto stepper = make_stepper(model, options);
  for (int s = 0; s < n_steps; ++s) REQUIRE(stepper->advance(state, s * options.step).ok());
  return state;
}

/// The largest gap between hanging vertices and the middle of their parents [m or m/s].
double largest_gap(const ClothModel& model, const Positions& columns) {
  Positions placed = columns;
  place_between_parents(model.hanging, placed);
  return (placed - columns).cwiseAbs().maxCoeff();
}

/// y of x = S y.
Eigen::VectorXd free_part(const ClothModel& model, const Positions& x) {
  Eigen::VectorXd y(3 * (model.n_vertices() - static_cast<int>(model.hanging.size())));
  Eigen::Index row = 0;
  for (int i = 0; i < model.n_vertices(); ++i) {
    if (model.masses[i] == 0) continue;
    y.segment<3>(row) = x.col(i);
    row += 3;
  }
  return y;
}

Eigen::VectorXd elastic_forces(const ClothModel& model, const Positions& x) {
  Positions forces = Positions::Zero(3, x.cols());
  add_elastic_forces(model, x, forces);
  return flat(forces);
}

}  // namespace

TEST_CASE("graded: the sheets of these tests have hanging neighbours", "[dynamics]") {
  int n_pairs = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const Graded sheet = graded(seed);
    for (const Spring& spring : sheet.model.springs)
      n_pairs += sheet.model.hangs(spring.a) && sheet.model.hangs(spring.b);
  }
  CHECK(n_pairs > 10);
}

TEST_CASE("graded: forces are the gradient of the energy in free vertices", "[dynamics]") {
  const std::uint64_t seed = GENERATE(1u, 2u);
  const Graded sheet = graded(seed);
  const Eigen::MatrixXd S = prolongation(sheet.model);
  const auto energy = [&](const Eigen::VectorXd& y) {
    return elastic_energy(sheet.model, columns(S * y));
  };
  const Eigen::VectorXd gradient = difference_gradient(
      energy, free_part(sheet.model, sheet.state.positions), difference_step(0.1));
  Positions forces = columns(elastic_forces(sheet.model, sheet.state.positions));
  pull_to_parents(sheet.model.hanging, forces);
  CHECK(relative_error(-free_part(sheet.model, forces), gradient) < 1e-8);
}

TEST_CASE("graded: the reduced matrix is the energy's Hessian in free vertices", "[dynamics]") {
  const std::uint64_t seed = GENERATE(1u, 2u);
  Graded sheet = graded(seed);
  // Hinges have blocks that are not symmetric.
  sheet.model.hinges = hinges(sheet.mesh.triangle_mesh(), soft_fabric().bend_warp);
  const Eigen::MatrixXd S = prolongation(sheet.model);
  const Eigen::MatrixXd hessian = difference_jacobian(
      [&](const Eigen::VectorXd& y) {
        return Eigen::VectorXd(-S.transpose() * elastic_forces(sheet.model, columns(S * y)));
      },
      free_part(sheet.model, sheet.state.positions), difference_step(0.1));
  SystemMatrix matrix(sheet.model);
  matrix.add_elasticity(sheet.state.positions, 1, 0, ElementHessian::exact);
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(S.rows());
  matrix.reduce_to_parents(rhs);
  // S keeps the rows of free vertices, and S^T S - 1 has nothing but hanging ones.
  Eigen::MatrixXd reduced = dense(matrix.lower());
  for (const HangingVertex& h : sheet.model.hanging) {
    Eigen::MatrixXd row = reduced.middleRows<3>(3 * h.vertex);
    CHECK((row.middleCols<3>(3 * h.vertex) - Mat3::Identity()).norm() == 0);
    row.middleCols<3>(3 * h.vertex).setZero();
    CHECK(row.norm() == 0);
    reduced.middleRows<3>(3 * h.vertex).setZero();
  }
  CHECK(relative_error(Eigen::MatrixXd(S.transpose() * reduced * S), hessian) < 1e-7);
}

TEST_CASE("graded: a second assembly leaves nothing of a reduced matrix", "[dynamics]") {
  const Graded sheet = graded(1);
  SystemMatrix matrix(sheet.model);
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(3 * sheet.model.n_vertices());
  const auto assemble = [&] {
    matrix.set_zero();
    matrix.add_masses(1);
    matrix.add_elasticity(sheet.state.positions, 2, 3, ElementHessian::exact);
    return dense(matrix.lower());
  };
  const Eigen::MatrixXd first = assemble();
  matrix.reduce_to_parents(rhs);
  CHECK((assemble() - first).norm() == 0);
}

TEST_CASE("graded: implicit solves the dense equations of the free vertices", "[dynamics]") {
  const std::uint64_t seed = GENERATE(1u, 2u, 3u);
  CAPTURE(seed);
  Graded sheet = graded(seed);
  ClothModel& model = sheet.model;
  model.gravity = {0, -9.81, 0};
  const double h = 0.01;
  pin_some_parents(sheet, {Motion::Kind::move, {0.1, 0.2, -0.3}, 0, 1, 0});
  const Eigen::MatrixXd S = prolongation(model);
  const Eigen::MatrixXd M = dense(mass_matrix(model));
  const Eigen::MatrixXd K =
      dense(stiffness_matrix(model, sheet.state.positions, ElementHessian::projected));
  const Eigen::MatrixXd C = dense(damping_matrix(model, sheet.state.positions));
  Positions forces = columns(elastic_forces(model, sheet.state.positions));
  add_gravity(model, forces);
  add_damping_forces(model, sheet.state.positions, sheet.state.velocities, forces);
  const Eigen::MatrixXd A = S.transpose() * (M + h * C + h * h * K) * S;
  const Eigen::VectorXd b =
      S.transpose() * (h * (flat(forces) - h * K * flat(sheet.state.velocities)));

  // Pins by Lagrange multipliers: rows of S pick a vertex out.
  const auto n = A.rows();
  const auto n_pins = static_cast<Eigen::Index>(model.pins.size());
  Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(n + 3 * n_pins, n + 3 * n_pins);
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(n + 3 * n_pins);
  bordered.topLeftCorner(n, n) = A;
  rhs.head(n) = b;
  for (Eigen::Index p = 0; p < n_pins; ++p) {
    const Pin& pin = model.pins[static_cast<std::size_t>(p)];
    bordered.block(n + 3 * p, 0, 3, n) = S.middleRows<3>(3 * pin.vertex);
    bordered.block(0, n + 3 * p, n, 3) = S.middleRows<3>(3 * pin.vertex).transpose();
    rhs.segment<3>(n + 3 * p) = pin.motion.offset - Vec3(sheet.state.velocities.col(pin.vertex));
  }
  const Eigen::VectorXd dv = S * bordered.fullPivLu().solve(rhs).head(n);
  const Positions expected = sheet.state.velocities + columns(dv);

  const State end = after_steps(model, method(&steppers::kImplicitEuler, h), sheet.state, 1);
  CHECK(relative_error(end.velocities, expected) < 1e-10);
  CHECK(relative_error(end.positions, Positions(sheet.state.positions + h * expected)) < 1e-10);
}

TEST_CASE("graded: implicit with cg reports the residual of the free vertices", "[dynamics]") {
  Graded sheet = graded(1);
  MethodOptions options = method(&steppers::kImplicitEuler, 0.01);
  options.solver = SolverKind::cg;
  options.tolerance = 1e-10;
  const State exact =
      after_steps(sheet.model, method(&steppers::kImplicitEuler, 0.01), sheet.state, 3);
  const State found = after_steps(sheet.model, options, sheet.state, 3);
  CHECK(relative_error(found.positions, exact.positions) < 1e-9);
}

TEST_CASE("graded: projective with many rounds solves newton's equations", "[dynamics]") {
  const std::uint64_t seed = GENERATE(1u, 2u);
  CAPTURE(seed);
  Graded sheet = graded(seed);
  for (Spring& spring : sheet.model.springs) spring.damping = 0;
  sheet.model.gravity = {0, -9.81, 0};
  pin_some_parents(sheet, {});
  const double h = 0.01;
  const State newton = after_steps(sheet.model, method(&steppers::kNewton, h), sheet.state, 1);
  const auto projective = make_stepper(sheet.model, method(&steppers::kProjective, h));
  State found = sheet.state;
  const SolveReport report = projective->advance(found, 0);
  CHECK(relative_error(found.positions, newton.positions) < 1e-8);
  CHECK(report.relative_residual < 1e-8);
}

TEST_CASE("graded: every stepper keeps the momentum of a sheet in flight", "[dynamics]") {
  const std::uint64_t seed = GENERATE(1u, 2u, 3u);
  Graded sheet = graded(seed);
  const Vec3 before = momentum(sheet.model, sheet.state);
  for (const MethodOptions& options : all_methods(0.001)) {
    CAPTURE(seed, options.stepper->name);
    // 20 steps; xpbd rounds to float32.
    const double tolerance = options.stepper->is_single_precision ? 1e-4 : 1e-11;
    const State end = after_steps(sheet.model, options, sheet.state, 20);
    CHECK((momentum(sheet.model, end) - before).norm() < tolerance * before.norm());
  }
}

TEST_CASE("graded: the angular momentum is kept as on uniform sheets", "[dynamics]") {
  Graded sheet = graded(GENERATE(1u, 2u));
  const Vec3 before = angular_momentum(sheet.model, sheet.state);
  for (const auto& [kind, tolerance] :
       {std::pair{&steppers::kExplicitEuler, 1e-11}, std::pair{&steppers::kRk4, 1e-6}}) {
    CAPTURE(kind->name);
    const State end = after_steps(sheet.model, method(kind, 0.001), sheet.state, 20);
    CHECK((angular_momentum(sheet.model, end) - before).norm() < tolerance * before.norm());
  }
}

TEST_CASE("graded: a hanging vertex is in the middle after every step", "[dynamics]") {
  const bool with_contact = GENERATE(false, true);
  Graded sheet = graded(3);
  sheet.model.gravity = {0, -9.81, 0};
  pin_some_parents(sheet, {Motion::Kind::oscillate, {0.1, 0, 0.1}, 0, 0, 2});
  sheet.model.air.emplace(sheet.mesh.crossed_triangles(), AirOptions{}, sheet.model.n_vertices(),
                          0.5);
  if (with_contact) {
    const double low = sheet.state.positions.row(1).minCoeff();
    sheet.model.contact.emplace(std::vector<Collider>{{Plane{{0, low, 0}, {0, 1, 0}}, {}, 0.3}},
                                ContactOptions{});
  }
  for (const MethodOptions& options : all_methods(0.001)) {
    CAPTURE(options.stepper->name, with_contact);
    const auto stepper = make_stepper(sheet.model, options);
    State state = sheet.state;
    for (int s = 0; s < 5; ++s) {
      REQUIRE(stepper->advance(state, s * options.step).ok());
      CHECK(largest_gap(sheet.model, state.positions) == 0);
      CHECK(largest_gap(sheet.model, state.velocities) == 0);
      for (const Pin& pin : sheet.model.pins)
        CHECK(state.positions.col(pin.vertex) == pin.position(s * options.step + options.step));
      if (!with_contact) continue;
      const Plane& floor = std::get<Plane>(sheet.model.contact->colliders()[0].shape);
      for (Eigen::Index i = 0; i < state.positions.cols(); ++i)
        if (!sheet.model.hangs(VertexId(i))) CHECK(state.positions(1, i) > floor.point.y() - 1e-12);
    }
  }
}

TEST_CASE("graded: a state is put between its parents to begin with", "[dynamics]") {
  Graded sheet = graded(1);
  State loose = sheet.state;
  loose.positions.col(sheet.model.hanging[0].vertex) += Vec3(0.1, 0.1, 0.1);
  loose.velocities.col(sheet.model.hanging[0].vertex) += Vec3(1, 1, 1);
  for (const MethodOptions& options : all_methods(0.001)) {
    CAPTURE(options.stepper->name);
    const State placed = after_steps(sheet.model, options, sheet.state, 1);
    CHECK(after_steps(sheet.model, options, loose, 1).positions == placed.positions);
  }
}

TEST_CASE("graded: refined everywhere it is the uniform sheet", "[dynamics]") {
  QuadMesh uniform = sheet_with_aspect(3, 3, 1.2);
  QuadMesh refined = uniform;
  uniform.refine_uniformly(1);
  for (int f = 0; f < 9; ++f) refined.refine(std::array{FaceId(f)});
  ClothModel expected_model = sheet_model(uniform, soft_fabric());
  ClothModel model = sheet_model(refined, soft_fabric());
  REQUIRE(model.hanging.empty());
  State expected = rest_state(uniform);
  State state = rest_state(refined);
  expected.velocities.row(2) = expected.positions.row(0);
  state.velocities.row(2) = state.positions.row(0);
  for (const MethodOptions& options : all_methods(0.001)) {
    CAPTURE(options.stepper->name);
    CHECK(after_steps(model, options, state, 5).positions ==
          after_steps(expected_model, options, expected, 5).positions);
  }
}

TEST_CASE("graded: the stability bound holds and is at most three times too careful",
          "[dynamics]") {
  const std::uint64_t seed = GENERATE(1u, 2u, 3u, 4u, 5u);
  const double stiffening = GENERATE(1.0, 1000.0);  // factor between hanging vertices
  CAPTURE(seed, stiffening);
  Graded sheet = graded(seed);
  for (Spring& spring : sheet.model.springs)
    if (sheet.model.hangs(spring.a) && sheet.model.hangs(spring.b)) spring.stiffness *= stiffening;
  const double h = largest_stable_step(sheet.model);
  const Eigen::MatrixXd S = prolongation(sheet.model);
  const Positions& x = sheet.mesh.rest_positions();
  const Eigen::MatrixXd M = S.transpose() * dense(mass_matrix(sheet.model)) * S;
  const Eigen::MatrixXd inverse_mass = M.diagonal().cwiseInverse().asDiagonal();
  const Eigen::MatrixXd K =
      S.transpose() * dense(stiffness_matrix(sheet.model, x, ElementHessian::projected)) * S;
  const Eigen::MatrixXd C = S.transpose() * dense(damping_matrix(sheet.model, x)) * S;
  const auto radius = [&](double step) {
    // (x, v) after a step of symplectic Euler: v+ = v - h M^-1 (K x + C v), x+ = x + h v+.
    const auto n = K.rows();
    Eigen::MatrixXd amplification = Eigen::MatrixXd::Identity(2 * n, 2 * n);
    amplification.bottomLeftCorner(n, n) = -step * inverse_mass * K;
    amplification.bottomRightCorner(n, n) -= step * inverse_mass * C;
    amplification.topRows(n) += step * amplification.bottomRows(n);
    return Eigen::EigenSolver<Eigen::MatrixXd>(amplification, false)
        .eigenvalues()
        .cwiseAbs()
        .maxCoeff();
  };
  CHECK(radius(h) < 1 + 1e-6);
  CHECK(radius(3 * h) > 1.5);
}

TEST_CASE("graded: xpbd with many substeps comes near to newton's small steps", "[dynamics]") {
  Graded sheet = graded(GENERATE(1u, 2u));
  sheet.model.gravity = {0, -9.81, 0};
  pin_some_parents(sheet, {});
  const double duration = 0.1;
  MethodOptions fine = method(&steppers::kNewton, duration / 100);
  fine.rule = NewtonRule::midpoint;
  const State exact = after_steps(sheet.model, fine, sheet.state, 100);
  const double moved = (exact.positions - sheet.state.positions).colwise().norm().maxCoeff();
  std::vector<double> errors;
  for (const int substeps : {100, 200, 400}) {
    MethodOptions xpbd = method(&steppers::kXpbd, duration);
    xpbd.substeps = substeps;
    xpbd.iterations = 1;
    const State found = after_steps(sheet.model, xpbd, sheet.state, 1);
    errors.push_back((found.positions - exact.positions).colwise().norm().maxCoeff() / moved);
  }
  CAPTURE(errors);
  CHECK(errors[2] < 0.01);
  CHECK(std::log2(errors[0] / errors[2]) == Approx(2).margin(0.5));  // first order
}

TEST_CASE("graded: xpbd gains no energy on a stiff sheet that swings", "[dynamics]") {
  const bool rigid = GENERATE(false, true);
  CAPTURE(rigid);
  QuadMesh mesh = square_sheet(6);
  for (int f = 0; f < 36; f += 5) mesh.refine(std::array{FaceId(f)});
  ClothModel model = sheet_model(mesh, library_fabric("fine cotton"));
  for (Spring& spring : model.springs) spring.damping = 0;
  model.gravity = {0, -9.81, 0};
  State state = rest_state(mesh);
  state.positions.row(2) = -state.positions.row(1);  // horizontal, held by one edge
  state.positions.row(1).setZero();
  for (int i = 0; i <= 6; ++i) model.pins.push_back({VertexId(i), state.positions.col(i), {}});
  MethodOptions options = method(&steppers::kXpbd, 1.0 / 60);
  options.substeps = 30;
  options.iterations = 1;
  if (rigid) options.constraints = Constraints::rigid;
  const auto stepper = make_stepper(model, options);
  if (rigid)
    for (Spring& spring : model.springs) spring.stiffness = 0;  // rigid springs store nothing
  const double before = total_energy(model, state);
  const double fall = model.masses.sum() * 9.81 * 0.5;  // middle falls by half of its length [J]
  for (int s = 0; s < 120; ++s) {
    REQUIRE(stepper->advance(state, s / 60.0).ok());
    CHECK(total_energy(model, state) - before < 0.01 * fall);
  }
}

TEST_CASE("graded: accurate methods agree", "[dynamics]") {
  Graded sheet = graded(2);
  sheet.model.gravity = {0, -9.81, 0};
  for (Spring& spring : sheet.model.springs) spring.damping = 0;
  pin_some_parents(sheet, {Motion::Kind::oscillate, {0.1, 0, 0.1}, 0, 0, 2});
  const double duration = 0.05;
  const auto at_end = [&](const StepperType* kind, int n_steps) {
    MethodOptions options = method(kind, duration / n_steps);
    if (kind == &steppers::kNewton) options.rule = NewtonRule::midpoint;
    return after_steps(sheet.model, options, sheet.state, n_steps).positions;
  };
  const Positions exact = at_end(&steppers::kRk4, 200);
  const double coarse = (at_end(&steppers::kNewton, 50) - exact).norm();
  const double fine = (at_end(&steppers::kNewton, 100) - exact).norm();
  CAPTURE(coarse, fine);
  CHECK(std::log2(coarse / fine) == Approx(2).margin(0.3));
}

TEST_CASE("graded: newton solves the damped equations of the free vertices", "[dynamics]") {
  Graded sheet = graded(1);
  for (Spring& spring : sheet.model.springs) spring.damping *= 20;
  const auto stepper = make_stepper(sheet.model, method(&steppers::kNewton, 0.01));
  const SolveReport report = stepper->advance(sheet.state, 0);
  REQUIRE(report.ok());
  CHECK(report.relative_residual < 1e-10);
}

TEST_CASE("graded: newton finds the rest of a held sheet", "[dynamics]") {
  Graded sheet = graded(1);
  sheet.model.gravity = {0, -9.81, 0};
  pin_some_parents(sheet, {});
  MethodOptions options = method(&steppers::kNewton, 1);
  options.rule = NewtonRule::equilibrium;
  const State end = after_steps(sheet.model, options, sheet.state, 1);
  Positions forces = columns(elastic_forces(sheet.model, end.positions));
  add_gravity(sheet.model, forces);
  pull_to_parents(sheet.model.hanging, forces);
  for (const Pin& pin : sheet.model.pins) forces.col(pin.vertex).setZero();
  CHECK(forces.norm() < 1e-9 * sheet.model.masses.sum() * 9.81);
}

TEST_CASE("graded: drag is shared among free vertices as mass is", "[dynamics]") {
  const QuadMesh mesh = graded_sheet(GENERATE(1u, 2u, 3u));
  const ClothModel model = sheet_model(mesh, soft_fabric());
  AirDrag air(mesh.crossed_triangles(), {}, mesh.n_vertices(), 0.5);
  const double h = GENERATE(0.0, 0.1);
  const Positions v = Vec3(0.3, -1, 2).replicate(1, mesh.n_vertices());
  Positions forces = Positions::Zero(3, mesh.n_vertices());
  const Positions others = forces;
  if (h == 0)
    air.add_forces(mesh.rest_positions(), v, model.hanging, forces);
  else
    air.set_damped_forces(mesh.rest_positions(), v, model.masses, model.hanging, h, others, forces);
  const Vec3 per_mass = forces.rowwise().sum() / model.masses.sum();
  CHECK(per_mass.norm() > 0.1);
  CHECK(relative_error(forces, Positions(per_mass * model.masses.transpose())) < 1e-12);
}

TEST_CASE("graded: motion is carried over to another grading", "[dynamics]") {
  Graded old = graded(GENERATE(1u, 2u));
  old.state.positions = 1.01 * old.mesh.rest_positions();
  old.state.velocities.colwise() = Vec3(0, 30, 0);  // [m/s], so that any tension is plausible
  QuadMesh mesh = old.mesh;
  for (int f = 0; f < 9; f += 2) mesh.refine(std::array{FaceId(f)});
  REQUIRE(mesh.n_vertices() > old.mesh.n_vertices());
  ClothModel model = sheet_model(mesh, soft_fabric());
  const MovingSheet from{old.mesh, old.model, old.state};
  const State state = carried_state(from, mesh);
  CHECK(largest_gap(model, state.positions) == 0);
  CHECK(relative_error(state.positions, Positions(1.01 * mesh.rest_positions())) < 1e-14);

  const MovingSheet to{mesh, model, state};
  const std::vector<double> rest_lengths = carried_rest_lengths(from, to);
  double sum_of_ratios = 0;
  for (std::size_t s = 0; s < rest_lengths.size(); ++s) {
    const double ratio = rest_lengths[s] / model.springs[s].rest_length;
    // Shear of the resultants cancels around a vertex with like faces on all sides only.
    CHECK(std::abs(ratio - 1) < 0.01);
    sum_of_ratios += ratio;
  }
  CHECK(sum_of_ratios / static_cast<double>(rest_lengths.size()) == Approx(1).margin(1e-3));
  const Positions weight = Vec3(0, -9.81, 0) * old.model.masses.transpose();
  const Positions carried = carried_forces(weight, from, to);
  CHECK(relative_error(carried, Positions(Vec3(0, -9.81, 0) * model.masses.transpose())) < 1e-12);
}

TEST_CASE("graded: the same start gives the same bits", "[dynamics]") {
  for (const MethodOptions& options : all_methods(0.001)) {
    CAPTURE(options.stepper->name);
    Graded sheet = graded(4);
    const State first = after_steps(sheet.model, options, sheet.state, 5);
    const State second = after_steps(sheet.model, options, sheet.state, 5);
    CHECK(first.positions == second.positions);
    CHECK(first.velocities == second.velocities);
  }
}

TEST_CASE("graded: nothing is allocated per step after the first", "[dynamics]") {
  if (!counts_allocations()) return;
  for (MethodOptions options : all_methods(0.001)) {
    CAPTURE(options.stepper->name);
    if (options.stepper == &steppers::kImplicitEuler) options.solver = SolverKind::cg;
    if (options.stepper == &steppers::kNewton) {
      if (!is_available(SolverKind::cholmod)) continue;  // Eigen's factorisation allocates
      options.solver = SolverKind::cholmod;
    }
    Graded sheet = graded(1);
    sheet.model.air.emplace(sheet.mesh.crossed_triangles(), AirOptions{}, sheet.model.n_vertices(),
                            0.5);
    sheet.model.contact.emplace(std::vector<Collider>{{Plane{{0, -3, 0}, {0, 1, 0}}, {}, 0.3}},
                                ContactOptions{});
    const auto stepper = make_stepper(sheet.model, options);
    stepper->advance(sheet.state, 0);
    CHECK(allocations_in([&] {
            for (int s = 1; s < 4; ++s) stepper->advance(sheet.state, s * options.step);
          }) == 0);
  }
}

TEST_CASE("graded: the energy ledger closes", "[dynamics]") {
  const auto drift = [](double step) {
    Graded sheet = graded(1);
    sheet.model.gravity = {0, -9.81, 0};
    pin_some_parents(sheet, {Motion::Kind::oscillate, {0.05, 0.02, 0.03}, 0, 0, 2});
    sheet.model.air.emplace(sheet.mesh.crossed_triangles(), AirOptions{}, sheet.model.n_vertices(),
                            0.5);
    const auto stepper = make_stepper(sheet.model, method(&steppers::kRk4, step));
    for (const Pin& pin : sheet.model.pins)
      sheet.state.velocities.col(pin.vertex) = pin.velocity(0);
    place_between_parents(sheet.model.hanging, sheet.state.velocities);
    EnergyLedger ledger(sheet.model, sheet.state);
    for (int s = 0; s < std::lround(0.1 / step); ++s) {
      const State begin = sheet.state;
      stepper->advance(sheet.state, s * step);
      ledger.record(begin, sheet.state, (s + 1) * step, step);
    }
    return ledger.relative_drift();
  };
  const double coarse = drift(0.002);
  const double fine = drift(0.001);
  CAPTURE(coarse, fine);
  CHECK(coarse < 0.01);
  CHECK(std::log2(coarse / fine) > 1);
}

TEST_CASE("graded: models that break a promise are refused", "[dynamics]") {
  Graded sheet = graded(1);
  ClothModel& model = sheet.model;
  const HangingVertex first = model.hanging.front();
  REQUIRE_NOTHROW(model.validate());
  SECTION("a mass of its own") { model.masses[first.vertex] = 1e-3; }
  SECTION("no mass where nothing hangs") { model.masses[first.parents[0]] = 0; }
  SECTION("not said to hang") { model.hanging.pop_back(); }
  SECTION("twice") { model.hanging.back() = first; }
  SECTION("a parent that hangs") { model.hanging.front().parents[0] = model.hanging[1].vertex; }
  SECTION("one parent twice") { model.hanging.front().parents[0] = first.parents[1]; }
  SECTION("a parent that does not exist") {
    model.hanging.front().parents[1] = VertexId(model.n_vertices());
  }
  SECTION("pinned") { model.pins.push_back({first.vertex, Vec3::Zero(), {}}); }
  CHECK_THROWS_AS(model.validate(), ContractError);
}

}  // namespace pleat
