#include "core/dynamics/explicit/stepper_explicit.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/base/check.h"
#include "core/dynamics/explicit/stability_bound.h"
#include "core/dynamics/stepper_table.h"
#include "core/model/system_matrix.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

MethodOptions explicit_method(double step, int substeps) {
  MethodOptions options;
  options.stepper = &steppers::kExplicitEuler;
  options.step = step;
  options.substeps = substeps;
  return options;
}

/// Largest eigenvalue in size of one step of symplectic or forward Euler linearised about these
/// positions.
double amplification(const ClothModel& model, const Positions& x, double h,
                     EulerRule rule = EulerRule::symplectic) {
  const Eigen::Index n = 3 * model.n_vertices();
  const Eigen::VectorXd inverse_mass = dense(mass_matrix(model)).diagonal().cwiseInverse();
  const Eigen::MatrixXd K =
      inverse_mass.asDiagonal() * dense(stiffness_matrix(model, x, ElementHessian::projected));
  const Eigen::MatrixXd C = inverse_mass.asDiagonal() * dense(damping_matrix(model, x));
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd step(2 * n, 2 * n);  // map of (x, v)
  if (rule == EulerRule::symplectic)
    step << I - h * h * K, h * (I - h * C), -h * K, I - h * C;
  else
    step << I, h * I, -h * K, I - h * C;
  return step.eigenvalues().cwiseAbs().maxCoeff();
}

/// Springs between random points, of stiffness and damping over three decades.
ClothModel random_graph(Random& random, Positions& x) {
  constexpr int kVertices = 9;
  constexpr int kSprings = 20;
  x = shaken(Positions::Zero(3, kVertices), 1, random);
  ClothModel model;
  model.masses.resize(kVertices);
  for (double& mass : model.masses) mass = std::pow(10, random.uniform(-3, 0));
  for (int s = 0; s < kSprings; ++s) {
    const VertexId a(random.below(kVertices));
    const VertexId b((a + 1 + random.below(kVertices - 1)) % kVertices);
    model.springs.push_back({a, b, std::pow(10, random.uniform(0, 3)),
                             (x.col(a.value) - x.col(b.value)).norm(),
                             std::pow(10, random.uniform(-3, 0)), SpringKind::other});
  }
  return model;
}

/// Two masses on a spring: the bound is exact there.
ClothModel pair_model(double damping) {
  ClothModel model;
  model.masses = Eigen::Vector2d(0.01, 0.01);
  model.springs = {{VertexId(0), VertexId(1), 100, 1, damping, SpringKind::other}};
  model.gravity.setZero();
  return model;
}

/// Largest stretch of the pair's spring over 4000 steps, begun at 1e-6 [m].
double largest_stretch(ClothModel model, double h) {
  State state{Positions::Zero(3, 2), Positions::Zero(3, 2)};
  state.positions(0, 1) = 1 + 1e-6;
  const auto stepper = make_stepper(model, explicit_method(h, 1));
  double largest = 0;
  for (int s = 0; s < 4000; ++s) {
    if (!stepper->advance(state, s * h).ok()) break;
    largest = std::max(largest, std::abs(state.positions(0, 1) - state.positions(0, 0) - 1));
  }
  return largest;
}

}  // namespace

TEST_CASE("explicit: below the bound nothing grows, on any graph of springs", "[dynamics]") {
  Random random(GENERATE(range(1, 21)));
  Positions x;
  const ClothModel model = random_graph(random, x);
  CHECK(amplification(model, x, largest_stable_step(model)) < 1 + 1e-6);
}

TEST_CASE("explicit: below the bound nothing grows on a sheet with bending", "[dynamics]") {
  const std::string name = GENERATE("canvas", "chiffon", "spandex");
  const QuadMesh mesh = sheet_with_aspect(4, 4, 1.2);
  FabricConstants fabric = library_fabric(name);
  fabric.bend_warp *= 1e4;  // so that bending sets the bound
  const double damping = GENERATE(0.0, 1.0);
  fabric.damping_ratio *= damping;
  CAPTURE(name, damping);
  const ClothModel model = sheet_model(mesh, fabric);
  const double bound = largest_stable_step(model);
  CHECK(amplification(model, mesh.rest_positions(), bound) < 1 + 1e-6);
  // The bound is a bound by circles, at most about twice too careful on a sheet.
  CHECK(amplification(model, mesh.rest_positions(), 2.2 * bound) > 1.01);
}

TEST_CASE("explicit: below the bound nothing grows on a membrane", "[dynamics]") {
  const std::string name = GENERATE("canvas", "chiffon", "spandex");
  const QuadMesh mesh = sheet_with_aspect(4, 4, 1.2);
  FabricConstants fabric = library_fabric(name);
  const double bending = GENERATE(1.0, 1e4);
  fabric.bend_warp *= bending;
  const double damping = GENERATE(0.0, 1.0);
  fabric.damping_ratio *= damping;
  CAPTURE(name, bending, damping);
  const ClothModel model = membrane_model(mesh, fabric);
  const double bound = largest_stable_step(model);
  CHECK(amplification(model, mesh.rest_positions(), bound) < 1 + 1e-6);
  CHECK(amplification(model, mesh.rest_positions(), 4 * bound) > 1.01);
}

TEST_CASE("explicit: hinges have no bound and are refused", "[dynamics]") {
  ClothModel model = model_of_everything(square_sheet(2), library_fabric("wool"));
  model.bend_friction.reset();
  MethodOptions options = explicit_method(1e-5, 1);
  options.stepper = GENERATE(&steppers::kExplicitEuler, &steppers::kRk4);
  CHECK_THROWS_AS(make_stepper(model, options), InputError);
}

TEST_CASE("explicit: the bound of two masses on a spring is the exact one", "[dynamics]") {
  const double damping = GENERATE(0.0, 0.5);
  CAPTURE(damping);
  const ClothModel model = pair_model(damping);
  const double bound = largest_stable_step(model);
  // h^2 k/mu + 2 h c/mu = 4 with the reduced mass mu.
  const double mu = 0.005;
  CHECK(bound * bound * 100 / mu + 2 * bound * damping / mu == Approx(4));
  CHECK(amplification(model, Positions(Vec3::UnitX() * Eigen::RowVector2d(0, 1)), 1.01 * bound) >
        1.01);
}

TEST_CASE("explicit: the bound of one bending element is exact where masses go as its weights",
          "[dynamics]") {
  ClothModel model;
  model.masses = Eigen::Vector3d(1, 2, 1);
  model.bends = {{{VertexId(0), VertexId(1), VertexId(2)}, {1, -2, 1}, 7}};
  // Its one eigenvalue is s (1/1 + 4/2 + 1/1) = 4 s.
  CHECK(largest_stable_step(model) == Approx(2 / std::sqrt(4 * 7.0)));
}

TEST_CASE("explicit: a run just below the bound stays, one just above is refused", "[dynamics]") {
  const double damping = GENERATE(0.0, 0.5);
  CAPTURE(damping);
  const double bound = largest_stable_step(pair_model(damping));
  CHECK(largest_stretch(pair_model(damping), 0.999 * bound) < 1e-3);
  CHECK_THROWS_AS(largest_stretch(pair_model(damping), 1.001 * bound), InputError);
}

TEST_CASE("explicit: the refusal names the bound and a count of substeps that runs", "[dynamics]") {
  ClothModel model = sheet_model(square_sheet(4), library_fabric("canvas"));
  int count = 0;
  try {
    make_stepper(model, explicit_method(1.0 / 60, 2));
    FAIL("nothing was thrown");
  } catch (const InputError& error) {
    const std::string text = error.sentence();
    CAPTURE(text);
    CHECK(error.where() == "/method/substeps");
    CHECK(text.find("got 0.00833 s") != std::string::npos);
    const std::size_t bracket = text.find('(');
    REQUIRE(bracket != std::string::npos);
    count = std::stoi(text.substr(bracket + 1));
  }
  CHECK_NOTHROW(make_stepper(model, explicit_method(1.0 / 60, count)));
}

TEST_CASE("explicit: cloth that needs more substeps than there can be is refused", "[dynamics]") {
  const int substeps = GENERATE(0, 1, kMaxSubsteps);
  CAPTURE(substeps);
  ClothModel model = pair_model(0);
  model.masses.setConstant(1e-15);
  for (Spring& spring : model.springs) spring.stiffness = 9e11;
  CHECK_THROWS_AS(make_stepper(model, explicit_method(1.0 / 60, substeps)), InputError);
}

TEST_CASE("explicit: left to choose, it takes the fewest substeps within its share of the bound",
          "[dynamics]") {
  ClothModel model = sheet_model(square_sheet(8), library_fabric("silk"));
  const double bound = largest_stable_step(model);
  const int substeps = make_stepper(model, explicit_method(1.0 / 60, 0))->substeps();
  CHECK(1.0 / 60 / substeps <= 0.9 * bound);
  CHECK(1.0 / 60 / (substeps - 1) > 0.9 * bound);
}

TEST_CASE("explicit: below forward Euler's bound nothing grows, on any graph of damped springs",
          "[dynamics]") {
  Random random(GENERATE(range(1, 21)));
  Positions x;
  ClothModel model = random_graph(random, x);
  model.damping_direction = DampingDirection::isotropic;
  CHECK(amplification(model, x, largest_forward_step(model), EulerRule::forward) < 1 + 1e-6);
}

TEST_CASE("explicit: forward Euler's bound of two masses on a spring is the exact one",
          "[dynamics]") {
  // It swings with the first damping, where h k = c, and fades with the second, where h c = m.
  const double damping = GENERATE(0.5, 50.0);
  CAPTURE(damping);
  ClothModel model = pair_model(damping);
  model.damping_direction = DampingDirection::isotropic;
  const double bound = largest_forward_step(model);
  CHECK(bound == Approx(damping == 0.5 ? 0.5 / 100 : 0.01 / 50));
  const Positions x = Vec3::UnitX() * Eigen::RowVector2d(0, 1);
  CHECK(amplification(model, x, bound, EulerRule::forward) < 1 + 1e-6);
  CHECK(amplification(model, x, 1.01 * bound, EulerRule::forward) > 1 + 1e-6);
}

TEST_CASE("explicit: forward Euler moves places with the old velocities", "[dynamics]") {
  ClothModel model;
  model.masses = Eigen::VectorXd::Ones(1);
  MethodOptions options = explicit_method(0.1, 1);
  options.euler = EulerRule::forward;
  State state{Vec3::Zero(), Vec3(1, 2, 3)};
  REQUIRE(make_stepper(model, options)->advance(state, 0).ok());
  CHECK((state.positions.col(0) - Vec3(0.1, 0.2, 0.3)).norm() < 1e-15);
  CHECK((state.velocities.col(0) - Vec3(1, 2 - 0.981, 3)).norm() < 1e-15);
}

TEST_CASE("explicit: forward Euler is refused where something is undamped", "[dynamics]") {
  MethodOptions options = explicit_method(1e-4, GENERATE(0, 1));
  options.euler = EulerRule::forward;
  ClothModel model = pair_model(0.5);
  CHECK_THROWS_WITH(make_stepper(model, options), Catch::Contains("forward"));  // turns undamped
  model.damping_direction = DampingDirection::isotropic;
  CHECK_NOTHROW(make_stepper(model, options));
  model.springs[0].damping = 0;
  CHECK_THROWS_WITH(make_stepper(model, options), Catch::Contains("forward"));
}

TEST_CASE("explicit: told to go on beyond the bound, it runs until the numbers end it",
          "[dynamics]") {
  MethodOptions options;
  options.stepper = GENERATE(&steppers::kExplicitEuler, &steppers::kRk4);
  ClothModel model = pair_model(0);
  options.step = 2 * largest_stable_step(model);
  CHECK_THROWS_AS(make_stepper(model, options), InputError);
  options.beyond_bound = BeyondBound::go_on;
  State state{Positions::Zero(3, 2), Positions::Zero(3, 2)};
  state.positions(0, 1) = 1 + 1e-6;
  const auto stepper = make_stepper(model, options);
  SolveReport report;
  for (int s = 0; s < 1000 && report.ok(); ++s) report = stepper->advance(state, s * options.step);
  CHECK(report.status == SolveStatus::not_finite);
  CHECK(state.positions.allFinite());
}

TEST_CASE("explicit: cloth without stiffness has no bound", "[dynamics]") {
  ClothModel model;
  model.masses = Eigen::VectorXd::Ones(3);
  CHECK(std::isinf(largest_stable_step(model)));
  CHECK(make_stepper(model, explicit_method(1, 0))->substeps() == 1);
}

}  // namespace pleat
