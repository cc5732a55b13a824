#include "core/dynamics/implicit/stepper_implicit.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <string>

#include "core/dynamics/stepper_table.h"
#include "core/model/elasticity.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

struct Crumpled {
  ClothModel model;
  State state;
};

/// A stiff sheet, held at two corners that move, crumpled and thrown.
Crumpled crumpled_sheet() {
  const QuadMesh mesh = sheet_with_aspect(6, 5, 1.2);
  Crumpled cloth{sheet_model(mesh, library_fabric("fine cotton")), rest_state(mesh)};
  Random random(1);
  cloth.model.gravity = {0, -9.81, 0};
  cloth.state.positions = shaken(cloth.state.positions, 0.05, random);
  cloth.state.velocities = shaken(cloth.state.velocities, 1, random);
  for (const int v : {0, 5}) {
    const Motion motion{Motion::Kind::move, {0.1, 0, 0.2}, 0, 1, 0};
    cloth.model.pins.push_back({VertexId(v), cloth.state.positions.col(v), motion});
  }
  return cloth;
}

State stepped(SolverKind solver, double tolerance) {
  Crumpled cloth = crumpled_sheet();
  MethodOptions options;
  options.solver = solver;
  options.tolerance = tolerance;
  const SolveReport report = make_stepper(cloth.model, options)->advance(cloth.state, 0);
  REQUIRE(report.ok());
  return cloth.state;
}

/// (M + h C + h^2 K) dv = h (f - h K v), pinned vertices eliminated, all dense.
State expected_step(double h) {
  Crumpled cloth = crumpled_sheet();
  const ClothModel& model = cloth.model;
  const Positions& x = cloth.state.positions;
  const Positions& v = cloth.state.velocities;
  const Eigen::Index n = x.size();
  const Eigen::MatrixXd K = dense(stiffness_matrix(model, x, ElementHessian::projected));
  const Eigen::MatrixXd A =
      dense(mass_matrix(model)) + h * dense(damping_matrix(model, x)) + h * h * K;
  Positions forces = Positions::Zero(3, x.cols());
  add_elastic_forces(model, x, forces);
  add_damping_forces(model, x, v, forces);
  add_gravity(model, forces);
  Eigen::VectorXd rhs = h * (Eigen::Map<const Eigen::VectorXd>(forces.data(), n) -
                             h * K * Eigen::Map<const Eigen::VectorXd>(v.data(), n));
  std::vector<Eigen::Index> free_rows;
  Eigen::VectorXd dv = Eigen::VectorXd::Zero(n);
  std::vector<bool> is_free(static_cast<std::size_t>(n), true);
  for (const Pin& pin : model.pins) {
    for (int k = 0; k < 3; ++k) is_free[static_cast<std::size_t>(3 * pin.vertex + k)] = false;
    dv.segment<3>(3 * pin.vertex) =
        (pin.position(h) - x.col(pin.vertex.value)) / h - v.col(pin.vertex.value);
  }
  for (Eigen::Index i = 0; i < n; ++i)
    if (is_free[static_cast<std::size_t>(i)]) free_rows.push_back(i);
  rhs -= A * dv;
  const Eigen::MatrixXd reduced = A(free_rows, free_rows);
  const Eigen::VectorXd reduced_rhs = rhs(free_rows);
  const Eigen::VectorXd solution = reduced.ldlt().solve(reduced_rhs);
  for (std::size_t i = 0; i < free_rows.size(); ++i)
    dv[free_rows[i]] = solution[static_cast<Eigen::Index>(i)];
  State end = cloth.state;
  end.velocities += Eigen::Map<const Positions>(dv.data(), 3, x.cols());
  end.positions += h * end.velocities;
  return end;
}

}  // namespace

TEST_CASE("implicit: CHOLMOD, Eigen and CG take the step of a dense solve", "[dynamics]") {
  const auto solver =
      GENERATE(SolverKind::cholmod, SolverKind::supernodal, SolverKind::eigen, SolverKind::cg);
  CAPTURE(name(solver));
  const State expected = expected_step(1.0 / 60);
  const State found = stepped(solver, 1e-12);
  // The condition number, about h^2 k/m = 1e4, times 1e-12.
  CHECK((found.velocities - expected.velocities).norm() < 1e-8 * expected.velocities.norm());
  CHECK((found.positions - expected.positions).norm() < 1e-8 * expected.positions.norm());
}

TEST_CASE("implicit: a looser CG tolerance gives a larger, reported residual", "[dynamics]") {
  Crumpled cloth = crumpled_sheet();
  MethodOptions options;
  options.tolerance = GENERATE(1e-2, 1e-4, 1e-8);
  const SolveReport report = make_stepper(cloth.model, options)->advance(cloth.state, 0);
  CHECK(report.ok());
  CHECK(report.iterations > 0);
  CHECK(report.relative_residual <= options.tolerance);
  CHECK(report.relative_residual > 1e-3 * options.tolerance);
}

TEST_CASE("implicit: a step a hundred times beyond the explicit bound loses energy", "[dynamics]") {
  Crumpled cloth = crumpled_sheet();
  cloth.model.pins.clear();
  cloth.model.gravity.setZero();
  MethodOptions options;
  options.solver = SolverKind::eigen;
  const auto stepper = make_stepper(cloth.model, options);
  double energy = total_energy(cloth.model, cloth.state);
  const double first = energy;
  for (int s = 0; s < 100; ++s) {
    REQUIRE(stepper->advance(cloth.state, s * options.step).ok());
    energy = total_energy(cloth.model, cloth.state);
    REQUIRE(energy < 1.01 * first);
  }
  CHECK(energy < 0.1 * first);
}

}  // namespace pleat
