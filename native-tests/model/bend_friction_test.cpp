#include "core/model/bend_friction.h"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/dynamics/stepper_table.h"
#include "core/model/elasticity.h"
#include "core/model/hanging_vertices.h"
#include "core/model/momentum.h"
#include "core/model/system_matrix.h"
#include "native-tests/support/finite_difference.h"
#include "native-tests/support/graded_sheets.h"
#include "native-tests/support/models.h"

using namespace pleat;
using Knee = BendFriction::Knee;

namespace {

constexpr double kHysteresis = 1.2e-3;           // 2HB [N], that of a cotton
constexpr double kMoment = kHysteresis / 2;      // at most [N]
constexpr double kYield = kPreSlidingCurvature;  // [1/m]
constexpr double kFrictionRigidity = kMoment / kYield;
constexpr double kRigidity = 1.2e-4;  // B [N m]: moments are in balance at 5 1/m

/// Strip in the plane z = 0, `rows` cells of 1 cm along x (warp) and one across, centred in x.
QuadMesh strip(int rows) {
  SheetShape shape;
  shape.height = 0.01 * rows;
  shape.width = 0.01;
  shape.rows = rows;
  shape.origin = {-shape.height / 2, 0, 0};
  shape.warp_direction = Vec3::UnitX();
  shape.weft_direction = Vec3::UnitY();
  return QuadMesh::sheet(shape);
}

/// Springs, bending and friction at rest at these places; nothing else acts.
ClothModel strip_model(const QuadMesh& mesh, const Positions& start) {
  FabricConstants fabric;
  fabric.bend_warp = fabric.bend_weft = kRigidity;
  ClothModel model = sheet_model(mesh, fabric);
  model.bend_friction.emplace(line_bends(mesh, 1), kHysteresis, mesh.crossed_triangles(),
                              mesh.rest_positions());
  model.bend_friction->restart(start);
  return model;
}

/// Places along a parabola; in the middle its normal is z and second differences are exact.
Positions parabola(const QuadMesh& mesh, double kappa) {
  Positions x = mesh.rest_positions();
  for (Eigen::Index i = 0; i < x.cols(); ++i) x(2, i) = kappa / 2 * x(0, i) * x(0, i);
  return x;
}

/// Places along a circle, lengths kept.
Positions arc(const QuadMesh& mesh, double kappa) {
  Positions x = mesh.rest_positions();
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const double angle = kappa * mesh.rest_positions()(0, i);
    x.col(i) << std::sin(angle) / kappa, x(1, i), (1 - std::cos(angle)) / kappa;
  }
  return x;
}

/// Only elements along x.
template <class Visit>
void for_each_along(const ClothModel& model, const QuadMesh& mesh, const Visit& visit) {
  for (const BendFriction::Element& element : model.bend_friction->elements()) {
    const auto& v = element.bend.vertices;
    if (std::abs(mesh.rest_positions()(0, v[2].value) - mesh.rest_positions()(0, v[0].value)) > 0)
      visit(element);
  }
}

/// Width times length of what bends along x [m^2].
double bent_area(const ClothModel& model, const QuadMesh& mesh) {
  double area = 0;
  for_each_along(model, mesh, [&](const BendFriction::Element& element) {
    area += element.bend.stiffness / kFrictionRigidity;
  });
  return area;
}

/// Moment per width of the parabola: -sum f dx/dkappa over the bent area.
double moment(const ClothModel& model, const QuadMesh& mesh, const Positions& x) {
  ClothModel bending = model;
  bending.springs.clear();
  Positions forces = Positions::Zero(3, x.cols());
  add_elastic_forces(bending, x, forces);
  double sum = 0;
  for (Eigen::Index i = 0; i < x.cols(); ++i) sum -= forces(2, i) * x(0, i) * x(0, i) / 2;
  return sum / bent_area(model, mesh);
}

/// Bends from one curvature to another without inertia.
void drive(ClothModel& model, const QuadMesh& mesh, double from, double to, Knee knee) {
  const int n_steps = 400;
  const double change = (to - from) / n_steps;
  for (int s = 0; s < n_steps; ++s) {
    const Positions begin = parabola(mesh, from + s * change);
    const Positions end = parabola(mesh, from + (s + 1) * change);
    model.bend_friction->begin_substep({begin, end - begin}, 1, knee);
    model.bend_friction->end_substep(end);
  }
}

/// The mean curvature along x [1/m].
double mean_curvature(const ClothModel& model, const QuadMesh& mesh, const Positions& x) {
  double sum = 0;
  int n = 0;
  for_each_along(model, mesh, [&](const BendFriction::Element& element) {
    Vec3 vector = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      vector += element.bend.weights[k] * x.col(element.bend.vertices[k]);
    sum += vector.norm();
    ++n;
  });
  return sum / n;
}

MethodOptions method(const StepperType* stepper) {
  MethodOptions options = stepper->usual_method();
  options.step = 1.0 / 500;
  options.substeps = 1;
  options.solver = SolverKind::eigen;
  return options;
}

/// A graded sheet with nothing but friction, within a substep that leads to both sides of the knee.
struct Shaken {
  explicit Shaken(std::uint64_t seed, Knee knee) : mesh(graded_sheet(seed)) {
    Random random(seed);
    model.masses = Eigen::VectorXd::Constant(mesh.n_vertices(), 0.01);
    for (const HangingVertex& h : mesh.hanging_vertices()) model.masses[h.vertex] = 0;
    model.hanging = mesh.hanging_vertices();
    model.bend_friction.emplace(line_bends(mesh, 1), kHysteresis, mesh.crossed_triangles(),
                                mesh.rest_positions());
    begin = shaken(mesh.rest_positions(), 0.01, random);
    model.bend_friction->restart(begin);
    ahead = shaken(begin, 0.3, random);
    model.bend_friction->begin_substep({begin, ahead - begin}, 1, knee);
    x = shaken(begin, 0.3, random);
  }

  QuadMesh mesh;
  ClothModel model;
  Positions begin;
  Positions ahead;
  Positions x;
};

}  // namespace

// M = B kappa +- 2HB/2 on the way up and down, once 2 e_y are behind the turn; a cycle loses 2HB
// times 2 (kappa_a - e_y).
TEST_CASE("bend_friction: a driven cycle has the measured slope, width and area", "[model]") {
  const Knee knee = GENERATE(Knee::exact, Knee::foreseen, Knee::in_middle);
  const double largest = GENERATE(30.0, 100.0);
  const QuadMesh mesh = strip(2);
  ClothModel model = strip_model(mesh, mesh.rest_positions());
  const auto moment_at = [&](double kappa) { return moment(model, mesh, parabola(mesh, kappa)); };
  drive(model, mesh, 0, largest, knee);
  CHECK(moment_at(largest) == Approx(kRigidity * largest + kMoment));
  const double before = model.bend_friction->dissipated();
  drive(model, mesh, largest, 0, knee);
  CHECK(moment_at(0) == Approx(-kMoment));
  drive(model, mesh, 0, -largest, knee);
  CHECK(moment_at(-largest) == Approx(-kRigidity * largest - kMoment));
  drive(model, mesh, -largest, 0, knee);
  CHECK(moment_at(0) == Approx(kMoment));
  drive(model, mesh, 0, largest, knee);
  const double lost = model.bend_friction->dissipated() - before;
  CHECK(lost == Approx(kHysteresis * 2 * (largest - kYield) * bent_area(model, mesh)));
}

// A third of the way to the knee and back: nothing slips, nothing is lost.
TEST_CASE("bend_friction: small swings are elastic", "[model]") {
  const QuadMesh mesh = strip(2);
  ClothModel model = strip_model(mesh, mesh.rest_positions());
  drive(model, mesh, 0, kYield / 3, Knee::exact);
  CHECK(moment(model, mesh, parabola(mesh, kYield / 3)) ==
        Approx((kRigidity + kFrictionRigidity) * kYield / 3));
  drive(model, mesh, kYield / 3, 0, Knee::exact);
  CHECK(std::abs(model.bend_friction->dissipated()) < 1e-12 * kMoment * kYield);
}

// Let go at kappa_0 without moments of friction, it unbends until B kappa = B_f (kappa_0 - kappa),
// or, if that is more than the friction holds, until B kappa = 2HB/2. Nearly without mass a strip
// gets there without swinging.
TEST_CASE("bend_friction: a bent strip that is let go stays bent", "[model]") {
  const StepperType* stepper = GENERATE(&steppers::kImplicitEuler, &steppers::kNewton);
  const double start = GENERATE(4.0, 8.0, 16.0);
  CAPTURE(stepper->name, start);
  const QuadMesh mesh = strip(8);
  State state{arc(mesh, start), Positions::Zero(3, mesh.n_vertices())};
  ClothModel model = strip_model(mesh, state.positions);
  model.masses *= 1e-4;
  const auto moving = make_stepper(model, method(stepper));
  for (int s = 0; s < 1000; ++s) {
    const SolveReport report = moving->advance(state, s / 500.0);
    INFO(report.message);
    REQUIRE(report.ok());
  }
  const double elastic = kFrictionRigidity * start / (kRigidity + kFrictionRigidity);
  const double expected = std::min(elastic, kMoment / kRigidity);
  CHECK(mean_curvature(model, mesh, state.positions) == Approx(expected).epsilon(0.02));
}

TEST_CASE("bend_friction: energy never grows", "[model]") {
  const StepperType* stepper = GENERATE(&steppers::kImplicitEuler, &steppers::kNewton);
  const auto seed = GENERATE(1u, 2u, 3u);
  const QuadMesh mesh = graded_sheet(seed);
  Random random(seed);
  State state{shaken(mesh.rest_positions(), 0.01, random), Positions()};
  state.velocities = shaken(Positions::Zero(3, mesh.n_vertices()), 1, random);
  ClothModel model = strip_model(mesh, state.positions);
  // Equations of `implicit` without springs are those of backward Euler to the last digit.
  if (stepper == &steppers::kImplicitEuler) model.springs.clear();
  const auto moving = make_stepper(model, method(stepper));
  double last = std::numeric_limits<double>::infinity();
  double first = 0;
  for (int s = 0; s < 200; ++s) {
    REQUIRE(moving->advance(state, s / 500.0).ok());
    const double now = total_energy(model, state);
    if (s == 0) first = now;
    REQUIRE(now <= last + 1e-9 * first);
    last = now;
  }
  CHECK(last < 0.99 * first);
  CHECK(model.bend_friction->dissipated() > 0);
}

TEST_CASE("bend_friction: linear momentum stays", "[model]") {
  const StepperType* stepper = GENERATE(&steppers::kImplicitEuler, &steppers::kNewton);
  const QuadMesh mesh = graded_sheet(5);
  Random random(5);
  State state{mesh.rest_positions(), shaken(Positions::Zero(3, mesh.n_vertices()), 1, random)};
  place_between_parents(mesh.hanging_vertices(), state);
  ClothModel model = strip_model(mesh, state.positions);
  const auto moving = make_stepper(model, method(stepper));
  const Vec3 before = momentum(model, state);
  for (int s = 0; s < 50; ++s) REQUIRE(moving->advance(state, s / 500.0).ok());
  CHECK((momentum(model, state) - before).norm() < 1e-9 * model.masses.sum());
}

TEST_CASE("bend_friction: forces and stiffness are the derivatives of its energy", "[model]") {
  const auto seed = GENERATE(1u, 2u, 3u);
  const Knee knee = GENERATE(Knee::exact, Knee::foreseen);
  const Shaken at(seed, knee);
  const auto forces = [&](const Eigen::VectorXd& x) {
    Positions sum = Positions::Zero(3, at.mesh.n_vertices());
    add_elastic_forces(at.model, columns(x), sum);
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(sum.data(), sum.size()));
  };
  const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(at.x.data(), at.x.size());
  const Eigen::VectorXd gradient = difference_gradient(
      [&](const Eigen::VectorXd& y) { return elastic_energy(at.model, columns(y)); }, x, 1e-6);
  CHECK(relative_error(forces(x), -gradient) < 1e-7);
  const Eigen::MatrixXd stiffness = dense(stiffness_matrix(at.model, at.x, ElementHessian::exact));
  CHECK(relative_error(stiffness, -difference_jacobian(forces, x, 1e-7)) < 1e-6);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness);
  CHECK(modes.eigenvalues().minCoeff() > -1e-12 * modes.eigenvalues().maxCoeff());
  CHECK(modes.eigenvalues().maxCoeff() > 0);
}

// They touch where the velocities lead to.
TEST_CASE("bend_friction: the foreseen parabola is nowhere below the potential", "[model]") {
  const auto seed = GENERATE(1u, 2u, 3u);
  const Shaken exact(seed, Knee::exact);
  const Shaken foreseen(seed, Knee::foreseen);
  const auto gap = [&](const Positions& x) {
    return foreseen.model.bend_friction->energy(x) - exact.model.bend_friction->energy(x);
  };
  const double least = gap(exact.ahead);
  Random random(seed + 10);
  for (int trial = 0; trial < 20; ++trial) {
    const Positions x = shaken(exact.ahead, 0.02 * (trial + 1), random);
    CHECK(gap(x) > least);
  }
}

// Foreseen to slip to 100 1/m, cloth that then hardly bends felt a twentieth of the law's moment.
TEST_CASE("bend_friction: no more is stored than moments did work", "[model]") {
  const double reached = GENERATE(0.01, 1.0, 4.0, 30.0, 200.0, -20.0);
  CAPTURE(reached);
  const QuadMesh mesh = strip(2);
  ClothModel model = strip_model(mesh, mesh.rest_positions());
  const Positions begin = parabola(mesh, 0);
  const Positions end = parabola(mesh, reached);
  model.bend_friction->begin_substep({begin, parabola(mesh, 100) - begin}, 1, Knee::foreseen);
  Positions forces = Positions::Zero(3, end.cols());
  model.bend_friction->add_forces(end, forces);
  const double work = -forces.cwiseProduct(end - begin).sum();
  model.bend_friction->end_substep(end);
  CHECK(model.bend_friction->energy(end) <= (1 + 1e-12) * work);
  CHECK(model.bend_friction->energy(end) > 0);
}

// A turn by a in a step moves kappa by kappa a^4/24 (core/model/bend_friction.cpp).
TEST_CASE("bend_friction: cloth that turns keeps its moments", "[model]") {
  const QuadMesh mesh = strip(8);
  const double kappa = 12;
  const Positions start = arc(mesh, kappa);
  ClothModel model = strip_model(mesh, mesh.rest_positions());
  model.bend_friction->restart(arc(mesh, kappa - 3));
  model.bend_friction->begin_substep({arc(mesh, kappa - 3), start - arc(mesh, kappa - 3)}, 1,
                                     Knee::exact);
  model.bend_friction->end_substep(start);
  BendFriction::Kept before;
  model.bend_friction->keep(before);
  const int n_steps = 60;
  const double turn = std::acos(-1.0) / n_steps;
  const Vec3 axis = Vec3(1, 2, 3).normalized();
  const auto turned = [&](double angle) {
    return Positions(Eigen::AngleAxisd(angle, axis).toRotationMatrix() * start);
  };
  for (int s = 0; s < n_steps; ++s) {
    const Positions x = turned(s * turn);
    Positions v(3, x.cols());
    for (Eigen::Index i = 0; i < x.cols(); ++i) v.col(i) = turn * axis.cross(Vec3(x.col(i)));
    model.bend_friction->begin_substep({x, v}, 1, Knee::exact);
    model.bend_friction->end_substep(turned((s + 1) * turn));
  }
  BendFriction::Kept after;
  model.bend_friction->keep(after);
  double largest = 0;
  double change = 0;
  for (std::size_t i = 0; i < before.strains.size(); ++i) {
    largest = std::max(largest, std::abs(before.strains[i]));
    change = std::max(change, std::abs(after.strains[i] - before.strains[i]));
  }
  CHECK(largest > 1);
  CHECK(change < 2 * n_steps * kappa * std::pow(turn, 4) / 24);
}

TEST_CASE("bend_friction: what is kept comes back to the bit", "[model]") {
  Shaken at(3, Knee::exact);
  BendFriction& friction = *at.model.bend_friction;
  friction.end_substep(at.x);
  BendFriction::Kept kept;
  friction.keep(kept);
  const double stored = friction.energy(at.x);
  REQUIRE(stored > 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  friction.begin_substep({at.x, at.x}, 1, Knee::foreseen);
  friction.end_substep(Positions::Constant(3, at.x.cols(), nan));
  friction.restore(kept, at.x);
  CHECK(friction.energy(at.x) == stored);
  CHECK(friction.dissipated() == kept.dissipated);
}

TEST_CASE("bend_friction: moments go on when normals turn, to the bit", "[model]") {
  Shaken at(4, Knee::exact);
  BendFriction& friction = *at.model.bend_friction;
  friction.end_substep(at.x);
  const double stored = friction.energy(at.x);
  const Positions v = Positions::Constant(3, at.x.cols(), 0.3).cwiseProduct(at.x);
  friction.begin_substep({at.x, v}, 0.1, Knee::exact);
  CHECK(friction.energy(at.x) == stored);
}

TEST_CASE("bend_friction: another mesh takes the moments of vertices that both have", "[model]") {
  const QuadMesh mesh = strip(4);
  ClothModel old = strip_model(mesh, arc(mesh, 2));
  old.bend_friction->begin_substep({arc(mesh, 2), arc(mesh, 2) * 0}, 1, Knee::exact);
  old.bend_friction->end_substep(arc(mesh, 4));
  ClothModel same = strip_model(mesh, arc(mesh, 4));
  same.bend_friction->take_moments(*old.bend_friction, arc(mesh, 4));
  CHECK(same.bend_friction->energy(arc(mesh, 4)) == old.bend_friction->energy(arc(mesh, 4)));
  QuadMesh fine = mesh;
  fine.refine_uniformly(1);
  ClothModel other = strip_model(fine, arc(fine, 4));
  other.bend_friction->take_moments(*old.bend_friction, arc(fine, 4));
  CHECK(other.bend_friction->energy(arc(fine, 4)) == 0);
  CHECK(other.bend_friction->dissipated() == old.bend_friction->dissipated());
}

TEST_CASE("bend_friction: a surface of no area has no moments, and no NaN", "[model]") {
  const QuadMesh mesh = strip(4);
  ClothModel model = strip_model(mesh, mesh.rest_positions());
  const Positions point = Positions::Zero(3, mesh.n_vertices());
  model.bend_friction->begin_substep({point, point}, 1, Knee::foreseen);
  model.bend_friction->end_substep(point);
  Positions forces = point;
  model.bend_friction->add_forces(point, forces);
  CHECK(forces.isZero(0));
}

TEST_CASE("bend_friction: steppers that do not take it refuse it", "[model]") {
  const QuadMesh mesh = strip(4);
  for (const StepperType* stepper : standard_steppers()) {
    ClothModel model = strip_model(mesh, mesh.rest_positions());
    model.surface = mesh.triangle_mesh();
    MethodOptions options = stepper->usual_method();
    if (stepper->takes_bend_friction) {
      CHECK_NOTHROW(make_stepper(model, options));
    } else {
      try {
        make_stepper(model, options);
        FAIL(stepper->name);
      } catch (const InputError& error) {
        CHECK(error.where() == "/method/stepper");
        CHECK(error.sentence() == std::string("expected implicit or newton for friction "
                                              "inside the fabric, whose moments they "
                                              "find with the end of a step as no other "
                                              "does, got ") +
                                      stepper->name);
      }
    }
  }
}
