#include "core/dynamics/position_based/step_solve.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <vector>

#include "core/base/random.h"
#include "core/dynamics/position_based/converged_step.h"
#include "core/dynamics/position_based/levels/independent_sets.h"
#include "core/dynamics/stepper_table.h"
#include "core/hierarchy/mesh_hierarchy.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr double kShortStep = 1e-3;  // [s]: a fall of 10 um, along springs of 100 mm

const std::vector<const StepperType*> kPositionBased = {&steppers::kXpbd, &steppers::kPbd,
                                                        &steppers::kHpbd, &steppers::kMultigrid};

/// A chain that hangs straight at its rest lengths, let go.
struct FallingChain {
  Chain chain;
  ClothModel model;
  State state;
  PredictedStep step;

  explicit FallingChain(int n_springs, double stiffness = 500) {
    chain.n_springs = n_springs;
    chain.stiffness = stiffness;
    chain.gravity = 200;
    model = chain_model(chain);
    state = hanging_state(chain);
    for (Eigen::Index v = 0; v < state.positions.cols(); ++v)
      state.positions.col(v) = Vec3(0, -chain.length * static_cast<double>(v), 0);
    step = predicted_step(model, state, kShortStep, kShortStep);
  }
};

MethodOptions pbd(Smoother smoother, double omega, Constraints constraints) {
  MethodOptions method = steppers::kPbd.usual_method();
  method.smoother_after = smoother;
  method.omega = omega;
  method.constraints = constraints;
  return method;
}

/// A lying sheet held by two corners that falls and shakes.
struct FallingSheet {
  ClothModel model;
  State state;

  explicit FallingSheet(int cells) {
    const QuadMesh mesh = lying_sheet(cells);
    model = sheet_model(mesh, library_fabric("fine cotton"));
    model.gravity = {0, 0, -9.81};
    model.surface = mesh.triangle_mesh();
    model.rest_coordinates = mesh.rest_coordinates();
    state = rest_state(mesh);
    Random random(4);
    for (double& v : state.velocities.reshaped()) v = random.uniform(-0.2, 0.2);
    for (const Eigen::Index v : {Eigen::Index(0), Eigen::Index(cells)})
      model.pins.push_back({VertexId(static_cast<int>(v)), state.positions.col(v), {}});
  }
};

/// A chain's equations A lambda = b: along a line they are linear. Lambda times w is a move.
struct ChainAlgebra {
  Eigen::MatrixXd J, W, A;  // C = J y + C_begin, A = J W J^T + compliance
  Eigen::VectorXd b;        // -C at the predicted places
  std::vector<int> order;   // order of springs in a sweep

  ChainAlgebra(const FallingChain& falling, bool is_rigid) {
    const ClothModel& model = falling.model;
    const auto n = static_cast<Eigen::Index>(model.springs.size());
    const double mean_mass = model.masses.mean();
    W = Eigen::VectorXd(mean_mass * model.masses.cwiseInverse()).asDiagonal();
    W(0, 0) = 0;
    J.setZero(n, n + 1);
    b.resize(n);
    std::vector<PlacePair> pairs;
    for (Eigen::Index s = 0; s < n; ++s) {
      const Spring& spring = model.springs[static_cast<std::size_t>(s)];
      const Vec3 d = falling.step.predicted.col(spring.a) - falling.step.predicted.col(spring.b);
      J(s, spring.a.value) = d.y() > 0 ? 1 : -1;
      J(s, spring.b.value) = -J(s, spring.a.value);
      b[s] = spring.rest_length - d.norm();
      pairs.push_back({spring.a.value, spring.b.value});
    }
    A = J * W * J.transpose();
    if (!is_rigid)
      A.diagonal().array() += mean_mass / (falling.chain.stiffness * kShortStep * kShortStep);
    for (const std::vector<int>& set :
         independent_sets(pairs, std::vector<bool>(model.springs.size() + 1, true)))
      order.insert(order.end(), set.begin(), set.end());
  }

  /// Residuals of so many sweeps of (D/omega + L) change = residual, L below D in the order.
  double relative_residual_of_sor(double omega, int sweeps) const {
    Eigen::VectorXd lambda = Eigen::VectorXd::Zero(b.size());
    const auto n = static_cast<Eigen::Index>(order.size());
    Eigen::MatrixXd P = Eigen::MatrixXd::Zero(n, n);  // the order
    for (Eigen::Index i = 0; i < n; ++i) P(i, order[static_cast<std::size_t>(i)]) = 1;
    const Eigen::MatrixXd ordered = P * A * P.transpose();
    Eigen::MatrixXd lower = ordered.triangularView<Eigen::StrictlyLower>();
    lower.diagonal() = ordered.diagonal() / omega;
    for (int sweep = 0; sweep < sweeps; ++sweep)
      lambda += P.transpose() * lower.triangularView<Eigen::Lower>().solve(P * (b - A * lambda));
    return (b - A * lambda).norm() / b.norm();
  }

  /// Moves by omega times the mean of what constraints ask of each node.
  double relative_residual_of_jacobi(double omega, int sweeps) const {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(J.cols());
    const Eigen::VectorXd counts = J.cwiseAbs().colwise().sum().transpose();
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      const Eigen::VectorXd asked = (b - J * y).cwiseQuotient(A.diagonal());
      y += omega * (W * J.transpose() * asked).cwiseQuotient(counts);
    }
    return (b - J * y).norm() / b.norm();
  }
};

double largest_distance(const Positions& x, const Positions& y) {
  return (x - y).colwise().norm().maxCoeff();
}

}  // namespace

TEST_CASE("predicted step: vertices go on and fall, pins are at their end", "[dynamics]") {
  FallingSheet sheet(4);
  sheet.model.pins[1].motion.kind = Motion::Kind::ease;
  sheet.model.pins[1].motion.offset = {0, 1, 0};
  sheet.model.pins[1].motion.time_end = 1;
  const double h = 0.01;
  const PredictedStep step = predicted_step(sheet.model, sheet.state, 0.5, h);
  CHECK(step.begins == sheet.state.positions);
  for (int v = 0; v < sheet.model.n_vertices(); ++v) {
    Vec3 expected = sheet.state.positions.col(v) + h * sheet.state.velocities.col(v) +
                    h * h * Vec3(0, 0, -9.81);
    for (const Pin& pin : sheet.model.pins)
      if (pin.vertex.value == v) expected = pin.place + (v == 0 ? Vec3(0, 0, 0) : Vec3(0, 0.5, 0));
    CHECK((step.predicted.col(v) - expected).norm() < 1e-14);
  }
}

TEST_CASE("step solve: every method begins at the predicted places, and repeats to the bit",
          "[dynamics]") {
  const auto* const type = GENERATE(from_range(kPositionBased));
  CAPTURE(type->name);
  const FallingSheet sheet(8);
  const PredictedStep step = predicted_step(sheet.model, sheet.state, kShortStep, kShortStep);
  StepSolve solve(sheet.model, type->usual_method(), step);
  solve.solve(0);
  CHECK(largest_distance(solve.positions(), step.predicted) < 1e-9);
  solve.solve(3);
  const Positions once = solve.positions();
  const double error = solve.relative_error();
  CHECK(largest_distance(once, step.predicted) > 1e-6);
  solve.solve(1);
  solve.solve(3);
  CHECK(solve.positions() == once);
  CHECK(solve.relative_error() == error);
}

TEST_CASE("step solve: it ends where a step of the stepper ends", "[dynamics]") {
  const auto* const type = GENERATE(from_range(kPositionBased));
  CAPTURE(type->name);
  FallingSheet sheet(8);
  MethodOptions method = type->usual_method();
  method.step = kShortStep;
  method.substeps = 1;
  method.iterations = 2;
  StepSolve solve(sheet.model, method,
                  predicted_step(sheet.model, sheet.state, kShortStep, kShortStep));
  solve.solve(2);
  REQUIRE(make_stepper(sheet.model, method)->advance(sheet.state, 0).ok());
  CHECK(largest_distance(solve.positions(), sheet.state.positions) < 1e-8);
}

TEST_CASE("step solve: of two springs a sweep leaves half of the error", "[dynamics]") {
  // The upper one gives all of it to the lower one, and that half of it back.
  FallingChain falling(2);
  falling.model.masses.setConstant(0.02);
  StepSolve solve(falling.model, pbd(Smoother::gauss_seidel, 0, Constraints::rigid), falling.step);
  for (int rounds = 1; rounds <= 4; ++rounds) {
    solve.solve(rounds);
    CHECK(solve.relative_error() == Approx(std::pow(0.5, rounds)).epsilon(5e-3));
  }
  CHECK(solve.sweeps_per_round() == 1);
}

TEST_CASE("step solve: smoothers are the iterations of dense algebra", "[dynamics]") {
  constexpr double kMargin = 2e-4;  // rounding of lengths in single precision, against the error
  const int sweeps = GENERATE(1, 3, 10);
  const FallingChain falling(9, 2e5);
  CAPTURE(sweeps);
  for (const Constraints constraints : {Constraints::rigid, Constraints::compliant}) {
    const ChainAlgebra algebra(falling, constraints == Constraints::rigid);
    const auto error = [&](Smoother smoother, double omega) {
      StepSolve solve(falling.model, pbd(smoother, omega, constraints), falling.step);
      solve.solve(sweeps);
      return solve.relative_error();
    };
    CHECK(error(Smoother::gauss_seidel, 0) ==
          Approx(algebra.relative_residual_of_sor(1, sweeps)).epsilon(1e-2).margin(kMargin));
    for (const double omega : {0.7, 1.5})
      CHECK(error(Smoother::sor, omega) ==
            Approx(algebra.relative_residual_of_sor(omega, sweeps)).epsilon(1e-2).margin(kMargin));
    if (constraints == Constraints::rigid)
      CHECK(error(Smoother::jacobi, 0.9) ==
            Approx(algebra.relative_residual_of_jacobi(0.9, sweeps)).epsilon(1e-2).margin(kMargin));
  }
}

TEST_CASE("step solve: more sweeps leave less", "[dynamics]") {
  const auto* const type = GENERATE(from_range(kPositionBased));
  CAPTURE(type->name);
  const FallingSheet sheet(12);
  StepSolve solve(sheet.model, type->usual_method(),
                  predicted_step(sheet.model, sheet.state, 1.0 / 60, 1.0 / 60));
  double last = 1;
  for (const int rounds : {1, 3, 9, 27}) {
    solve.solve(rounds);
    CHECK(solve.relative_error() < last);
    last = solve.relative_error();
  }
}

TEST_CASE("step solve: coarse sweeps count by their share of constraints", "[dynamics]") {
  const FallingSheet sheet(12);
  const PredictedStep step = predicted_step(sheet.model, sheet.state, kShortStep, kShortStep);
  MethodOptions method = steppers::kMultigrid.usual_method();
  method.attachments = Attachments::none;
  HierarchyOptions options;
  options.n_coarser = method.levels;
  options.ratio = method.ratio;
  std::vector<bool> is_fixed(static_cast<std::size_t>(sheet.model.n_vertices()), false);
  for (const Pin& pin : sheet.model.pins) is_fixed[pin.vertex] = true;
  double share = 0;
  for (const MeshLevel& level : mesh_hierarchy(sheet.model.surface, is_fixed, options).levels)
    share += static_cast<double>(level.edges.size());
  const MeshHierarchy hierarchy = mesh_hierarchy(sheet.model.surface, is_fixed, options);
  share -= static_cast<double>(hierarchy.levels.front().edges.size());
  share /= static_cast<double>(sheet.model.springs.size() + sheet.model.bends.size());
  CHECK(StepSolve(sheet.model, method, step).sweeps_per_round() == Approx(2 * (1 + share)));
  method.smoother_before = Smoother::none;
  CHECK(StepSolve(sheet.model, method, step).sweeps_per_round() == Approx(1 + share));
}

TEST_CASE("step solve: by errors, cycles of levels converge in a fraction of a level's sweeps",
          "[dynamics]") {
  const Constraints constraints = GENERATE(Constraints::rigid, Constraints::compliant);
  FallingSheet sheet(32);
  sheet.state.velocities.setZero();
  sheet.model.gravity = {9.81, 0, 0};  // pulls along the sheet, away from its pins
  sheet.model.bends.clear();
  const PredictedStep step = predicted_step(sheet.model, sheet.state, 1.0 / 60, 1.0 / 60);
  MethodOptions method = steppers::kMultigrid.usual_method();
  method.constraints = constraints;
  method.level_lengths = LevelLengths::error;
  method.smoother_before = Smoother::none;
  method.attachments = Attachments::none;
  StepSolve levels(sheet.model, method, step);
  StepSolve plain(sheet.model, pbd(Smoother::gauss_seidel, 0, constraints), step);
  levels.solve(60);
  plain.solve(static_cast<int>(4 * 60 * levels.sweeps_per_round()));
  CAPTURE(levels.relative_error(), plain.relative_error());
  CHECK(levels.relative_error() < 0.02);
  CHECK(levels.relative_error() < plain.relative_error());
}

TEST_CASE("converged step: of a chain it is the dense solution, of a sheet what sweeps come to",
          "[dynamics]") {
  const FallingChain falling(9, 2e5);
  const ChainAlgebra algebra(falling, false);
  const ConvergedStep chain = converged_step(falling.model, falling.step);
  REQUIRE(chain.is_converged);
  const Eigen::VectorXd moves =
      algebra.W * algebra.J.transpose() * algebra.A.ldlt().solve(algebra.b);
  CHECK((chain.positions.row(1) - falling.step.predicted.row(1) - moves.transpose())
            .cwiseAbs()
            .maxCoeff() < 1e-12);

  const FallingSheet sheet(6);
  const double h = 1e-3;
  const PredictedStep step = predicted_step(sheet.model, sheet.state, h, h);
  const ConvergedStep converged = converged_step(sheet.model, step);
  REQUIRE(converged.is_converged);
  CHECK(converged.relative_error < 1e-9);
  StepSolve solve(sheet.model, pbd(Smoother::gauss_seidel, 0, Constraints::compliant), step);
  solve.solve(3000);
  CHECK(solve.relative_error() < 1e-3);
  CHECK(largest_distance(solve.positions(), converged.positions) <
        0.01 * largest_distance(step.predicted, converged.positions));
}

}  // namespace pleat
