#include "core/model/elasticity.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/model/system_matrix.h"
#include "native-tests/support/finite_difference.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr double kEdge = 0.25;  // edge of the small sheet [m]

QuadMesh small_sheet() { return sheet_with_aspect(4, 4, 1.2); }

/// Stretched and crumpled: some springs in tension, some compressed.
Positions crumpled(const QuadMesh& mesh, Random& random) {
  return shaken(mesh.rest_positions(), 0.3 * kEdge, random);
}

/// Every spring in tension.
Positions inflated(const QuadMesh& mesh, Random& random) {
  return shaken(1.3 * mesh.rest_positions(), 0.02 * kEdge, random);
}

Eigen::VectorXd elastic_forces(const ClothModel& model, const Eigen::VectorXd& x) {
  Positions forces = Positions::Zero(3, x.size() / 3);
  add_elastic_forces(model, columns(x), forces);
  return flat(forces);
}

Mat3 random_rotation(Random& random) {
  const Vec3 axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  return Eigen::AngleAxisd(random.uniform(0, 3), axis.normalized()).toRotationMatrix();
}

}  // namespace

TEST_CASE("elasticity: forces are minus the gradient of the energy", "[model]") {
  Random random(GENERATE(1, 2, 3));
  const QuadMesh mesh = small_sheet();
  const ClothModel model = sheet_model(mesh, soft_fabric());
  const Eigen::VectorXd x = flat(crumpled(mesh, random));
  const Eigen::VectorXd gradient = difference_gradient(
      [&](const Eigen::VectorXd& y) { return elastic_energy(model, columns(y)); }, x,
      difference_step(kEdge));
  CHECK(relative_error(-elastic_forces(model, x), gradient) < 1e-8);
}

TEST_CASE("elasticity: the exact stiffness is minus the derivative of the forces", "[model]") {
  Random random(GENERATE(1, 2, 3));
  const QuadMesh mesh = small_sheet();
  const ClothModel model = sheet_model(mesh, soft_fabric());
  const Eigen::VectorXd x = flat(crumpled(mesh, random));
  const Eigen::MatrixXd jacobian =
      difference_jacobian([&](const Eigen::VectorXd& y) { return elastic_forces(model, y); }, x,
                          difference_step(kEdge));
  CHECK(relative_error(dense(stiffness_matrix(model, columns(x), ElementHessian::exact)),
                       -jacobian) < 1e-7);
}

TEST_CASE("elasticity: every kind of element has its own derivatives", "[model]") {
  Random random(GENERATE(1, 2, 3));
  const QuadMesh mesh = sheet_with_aspect(3, 3, 1.2);
  FabricConstants fabric = library_fabric("wool");
  fabric.bend_warp *= 1e4;  // so that bending is seen beside stretch
  fabric.bend_weft *= 1e4;
  const ClothModel model = model_of_everything(mesh, fabric);
  REQUIRE(!model.taut_springs.empty());
  REQUIRE(!model.chord_bends.empty());
  REQUIRE(!model.hinges.empty());
  REQUIRE(model.has_fitted_bending());
  const Eigen::VectorXd x = flat(crumpled(mesh, random));
  const double step = difference_step(kEdge);
  const Eigen::VectorXd gradient = difference_gradient(
      [&](const Eigen::VectorXd& y) { return elastic_energy(model, columns(y)); }, x, step);
  CHECK(relative_error(-elastic_forces(model, x), gradient) < 1e-7);
  const Eigen::MatrixXd jacobian = difference_jacobian(
      [&](const Eigen::VectorXd& y) { return elastic_forces(model, y); }, x, step);
  CHECK(relative_error(dense(stiffness_matrix(model, columns(x), ElementHessian::exact)),
                       -jacobian) < 1e-6);
  const Positions velocities = shaken(Positions::Zero(3, mesh.n_vertices()), 1, random);
  Positions drag = Positions::Zero(3, mesh.n_vertices());
  add_damping_forces(model, columns(x), velocities, drag);
  CHECK(relative_error(flat(drag), -dense(damping_matrix(model, columns(x))) * flat(velocities)) <
        1e-12);
  CHECK(drag.cwiseProduct(velocities).sum() < 0);
}

TEST_CASE("elasticity: the projected stiffness of everything is positive", "[model]") {
  Random random(GENERATE(5, 6));
  const QuadMesh mesh = sheet_with_aspect(3, 3, 1.2);
  const ClothModel model = model_of_everything(mesh, library_fabric("wool"));
  const Eigen::MatrixXd K =
      dense(stiffness_matrix(model, crumpled(mesh, random), ElementHessian::projected));
  const Eigen::VectorXd values = K.selfadjointView<Eigen::Lower>().eigenvalues();
  CHECK(values[0] > -1e-12 * values.tail<1>()[0]);
}

TEST_CASE("elasticity: a membrane that moves as one has no forces and no drag", "[model]") {
  Random random(3);
  const QuadMesh mesh = small_sheet();
  const ClothModel model = membrane_model(mesh, library_fabric("wool"));
  const Mat3 turn = random_rotation(random);
  const Positions x = (turn * mesh.rest_positions()).colwise() + Vec3(3, -2, 1);
  const Eigen::VectorXd strained = elastic_forces(model, flat(inflated(mesh, random)));
  CHECK(elastic_forces(model, flat(x)).norm() < 1e-11 * strained.norm());
  const Vec3 spin(1, 2, 3);
  Positions velocities(3, x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i) velocities.col(i) = spin.cross(Vec3(x.col(i)));
  Positions drag = Positions::Zero(3, x.cols());
  add_damping_forces(model, x, velocities, drag);
  Positions stretching = Positions::Zero(3, x.cols());
  add_damping_forces(model, x, x, stretching);
  REQUIRE(stretching.norm() > 0);
  CHECK(drag.norm() < 1e-11 * stretching.norm());
}

TEST_CASE("elasticity: bending weighs the same far from the origin", "[model]") {
  Random random(4);
  const QuadMesh mesh = small_sheet();
  ClothModel model = membrane_model(mesh, library_fabric("wool"));
  model.membrane.elements.clear();
  const Positions x = crumpled(mesh, random);
  const Positions away = x.colwise() + Vec3(1e4, -1e4, 1e4);
  CHECK(elastic_energy(model, away) == Approx(elastic_energy(model, x)).epsilon(1e-9));
}

TEST_CASE("elasticity: the bending stiffness alone is the derivative of its forces", "[model]") {
  Random random(4);
  const QuadMesh mesh = small_sheet();
  ClothModel model = sheet_model(mesh, library_fabric("wool"));
  model.springs.clear();
  const Eigen::VectorXd x = flat(crumpled(mesh, random));
  const Eigen::MatrixXd jacobian =
      difference_jacobian([&](const Eigen::VectorXd& y) { return elastic_forces(model, y); }, x,
                          difference_step(kEdge));
  CHECK(relative_error(dense(stiffness_matrix(model, columns(x), ElementHessian::exact)),
                       -jacobian) < 1e-8);
}

TEST_CASE("elasticity: damping is minus the derivative of the damping forces by velocity",
          "[model]") {
  const auto direction = GENERATE(DampingDirection::along_spring, DampingDirection::isotropic);
  Random random(5);
  const QuadMesh mesh = small_sheet();
  ClothModel model = sheet_model(mesh, soft_fabric());
  model.damping_direction = direction;
  const Positions x = crumpled(mesh, random);
  const Eigen::VectorXd v = flat(shaken(Positions::Zero(3, x.cols()), 1, random));
  const Eigen::MatrixXd jacobian = difference_jacobian(
      [&](const Eigen::VectorXd& w) -> Eigen::VectorXd {
        Positions forces = Positions::Zero(3, x.cols());
        add_damping_forces(model, x, columns(w), forces);
        return flat(forces);
      },
      v, difference_step(1));
  CHECK(relative_error(dense(damping_matrix(model, x)), -jacobian) < 1e-9);
}

TEST_CASE("elasticity: internal forces are elastic and damping ones in one pass", "[model]") {
  const auto direction = GENERATE(DampingDirection::along_spring, DampingDirection::isotropic);
  Random random(5);
  const QuadMesh mesh = small_sheet();
  ClothModel model = sheet_model(mesh, soft_fabric());
  model.damping_direction = direction;
  model.springs.front().damping = 0;
  const Positions x = crumpled(mesh, random);
  const Positions v = shaken(Positions::Zero(3, x.cols()), 1, random);
  Positions apart = Positions::Zero(3, x.cols());
  add_elastic_forces(model, x, apart);
  add_damping_forces(model, x, v, apart);
  Positions together = Positions::Zero(3, x.cols());
  add_internal_forces(model, x, v, together);
  CHECK((together - apart).norm() < 1e-14 * apart.norm());
}

TEST_CASE("elasticity: damping along springs takes energy and leaves rotation alone", "[model]") {
  Random random(6);
  const QuadMesh mesh = small_sheet();
  const ClothModel model = sheet_model(mesh, soft_fabric());
  const Positions x = crumpled(mesh, random);
  const auto power = [&](const Positions& v) {
    Positions forces = Positions::Zero(3, x.cols());
    add_damping_forces(model, x, v, forces);
    return forces.cwiseProduct(v).sum();
  };
  const Positions tossed = shaken(Positions::Zero(3, x.cols()), 1, random);
  const Vec3 omega(0.3, -0.7, 0.5);
  Positions turning(3, x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i) turning.col(i) = omega.cross(Vec3(x.col(i)));
  CHECK(power(tossed) < 0);
  CHECK(std::abs(power(turning)) < 1e-14 * std::abs(power(tossed)));
}

TEST_CASE("elasticity: the projected stiffness is the exact one where springs are in tension",
          "[model]") {
  Random random(7);
  const QuadMesh mesh = small_sheet();
  const ClothModel model = sheet_model(mesh, soft_fabric());
  const Positions x = inflated(mesh, random);
  CHECK(relative_error(dense(stiffness_matrix(model, x, ElementHessian::projected)),
                       dense(stiffness_matrix(model, x, ElementHessian::exact))) < 1e-14);
}

TEST_CASE("elasticity: only the projected stiffness is semidefinite when springs are compressed",
          "[model]") {
  Random random(GENERATE(8, 9));
  const QuadMesh mesh = small_sheet();
  const ClothModel model = sheet_model(mesh, soft_fabric());
  const Positions x = shaken(0.7 * mesh.rest_positions(), 0.1 * kEdge, random);
  const auto extremes = [&](ElementHessian hessian) {
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(stiffness_matrix(model, x, hessian)))
            .eigenvalues();
    return std::pair(values.minCoeff(), values.maxCoeff());
  };
  const auto [lowest_projected, highest] = extremes(ElementHessian::projected);
  CHECK(lowest_projected > -1e-13 * highest);
  CHECK(extremes(ElementHessian::exact).first < -1e-3 * highest);
}

TEST_CASE("elasticity: a rigid motion leaves the energy and turns the forces along", "[model]") {
  Random random(GENERATE(10, 11));
  const QuadMesh mesh = small_sheet();
  const ClothModel model = sheet_model(mesh, soft_fabric());
  const Positions x = crumpled(mesh, random);
  const Mat3 R = random_rotation(random);
  const Positions moved = (R * x).colwise() + Vec3(3, -2, 5);
  CHECK(elastic_energy(model, moved) == Approx(elastic_energy(model, x)).epsilon(1e-12));
  const Positions forces = columns(elastic_forces(model, flat(x)));
  CHECK(relative_error(columns(elastic_forces(model, flat(moved))), R * forces) < 1e-12);
}

TEST_CASE("elasticity: inner forces have neither resultant nor moment", "[model]") {
  Random random(12);
  const QuadMesh mesh = small_sheet();
  const ClothModel model = sheet_model(mesh, soft_fabric());
  const Positions x = crumpled(mesh, random);
  Positions forces = columns(elastic_forces(model, flat(x)));
  add_damping_forces(model, x, shaken(Positions::Zero(3, x.cols()), 1, random), forces);
  Vec3 moment = Vec3::Zero();
  for (Eigen::Index i = 0; i < x.cols(); ++i) moment += Vec3(x.col(i)).cross(Vec3(forces.col(i)));
  CHECK(forces.rowwise().sum().norm() < 1e-13 * forces.norm());
  CHECK(moment.norm() < 1e-13 * forces.norm());
}

TEST_CASE("elasticity: a spring of zero length pulls nowhere and leaves no NaN", "[model]") {
  const double rest_length = GENERATE(0.0, 0.1);
  CAPTURE(rest_length);
  ClothModel model;
  model.masses = Eigen::VectorXd::Ones(2);
  model.springs = {{VertexId(0), VertexId(1), 10, rest_length, 1, SpringKind::other}};
  const Positions x = Positions::Ones(3, 2);
  Positions v = Positions::Zero(3, 2);
  v(0, 0) = 1;
  Positions forces = Positions::Zero(3, 2);
  add_elastic_forces(model, x, forces);
  add_damping_forces(model, x, v, forces);
  CHECK(forces.isZero(0));
  for (const auto hessian : {ElementHessian::exact, ElementHessian::projected})
    CHECK(dense(stiffness_matrix(model, x, hessian)).allFinite());
  CHECK(dense(damping_matrix(model, x)).allFinite());
}

TEST_CASE("elasticity: energy is kinetic, elastic and by height", "[model]") {
  ClothModel model;
  model.masses = Eigen::Vector2d(2, 3);
  model.springs = {{VertexId(0), VertexId(1), 10, 1, 0, SpringKind::other}};
  model.gravity = {0, -10, 0};
  State state{Positions::Zero(3, 2), Positions::Zero(3, 2)};
  state.positions(1, 1) = 1.5;
  state.velocities(0, 0) = 4;
  const EnergyParts parts = energy_parts(model, state);
  CHECK(parts.kinetic == Approx(0.5 * 2 * 16));
  CHECK(parts.elastic == Approx(0.5 * 10 * 0.25));
  CHECK(parts.gravity == Approx(3 * 10 * 1.5));
  CHECK(total_energy(model, state) == Approx(parts.kinetic + parts.elastic + parts.gravity));
}

TEST_CASE("cloth_model: broken promises are named", "[model]") {
  ClothModel model = chain_model({});
  REQUIRE_NOTHROW(model.validate());
  SECTION("mass") { model.masses[1] = 0; }
  SECTION("NaN mass") { model.masses[1] = std::nan(""); }
  SECTION("missing vertex") { model.springs[0].b = VertexId(99); }
  SECTION("spring to itself") { model.springs[0].b = model.springs[0].a; }
  SECTION("negative stiffness") { model.springs[0].stiffness = -1; }
  SECTION("two pins") { model.pins.push_back(model.pins[0]); }
  SECTION("pin on a missing vertex") { model.pins[0].vertex = VertexId(-1); }
  SECTION("infinite gravity") { model.gravity.x() = INFINITY; }
  SECTION("bending element") {
    model.bends.push_back({{VertexId(0), VertexId(1), VertexId(77)}, {}, 1});
  }
  SECTION("rest coordinates") { model.rest_coordinates.resize(2, 3); }
  CHECK_THROWS_AS(model.validate(), ContractError);
}

}  // namespace pleat
