#include "core/dynamics/implicit/stepper_projective.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/dynamics/stepper_table.h"
#include "core/model/elasticity.h"
#include "core/model/system_matrix.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr double kStep = 0.01;  // [s]

MethodOptions projective(int rounds, Acceleration acceleration = Acceleration::none) {
  MethodOptions options;
  options.stepper = &steppers::kProjective;
  options.step = kStep;
  options.solver = SolverKind::eigen;
  options.iterations = rounds;
  options.acceleration = acceleration;
  return options;
}

struct Cloth {
  ClothModel model;
  State state;
};

/// Springs, dampers, bending, gravity and a moving pin.
Cloth soft_sheet(DampingDirection direction) {
  const QuadMesh mesh = sheet_with_aspect(3, 3, 1.2);
  Cloth cloth{sheet_model(mesh, soft_fabric()), rest_state(mesh)};
  Random random(2);
  cloth.model.damping_direction = direction;
  cloth.model.gravity = {0, -9.81, 0};
  for (Spring& spring : cloth.model.springs) spring.damping *= 5;  // so that it matters
  cloth.state.positions = shaken(1.05 * cloth.state.positions, 0.02, random);
  cloth.state.velocities = shaken(cloth.state.velocities, 1, random);
  const Motion motion{Motion::Kind::move, {0.1, 0.05, 0.2}, 0, 0.1, 0};
  cloth.model.pins.push_back({VertexId(3), cloth.state.positions.col(3), motion});
  return cloth;
}

/// Gradient of |x - y|^2_M / (2 h^2) + E(x) + dampers, whose root is the backward Euler step.
Eigen::VectorXd gradient(const Cloth& cloth, const Eigen::VectorXd& flat_x) {
  const ClothModel& model = cloth.model;
  const Eigen::Map<const Positions> x(flat_x.data(), 3, model.n_vertices());
  Positions g = Positions::Zero(3, model.n_vertices());
  add_elastic_forces(model, x, g);
  g = -g;
  for (const Spring& spring : model.springs) {
    const Vec3 d = x.col(spring.a.value) - x.col(spring.b.value);
    const Vec3 begin =
        cloth.state.positions.col(spring.a.value) - cloth.state.positions.col(spring.b.value);
    const Vec3 drag =
        model.damping_direction == DampingDirection::isotropic
            ? Vec3(spring.damping / kStep * (d - begin))
            : Vec3(spring.damping / kStep * (d.norm() - begin.norm()) * d.normalized());
    g.col(spring.a.value) += drag;
    g.col(spring.b.value) -= drag;
  }
  for (int i = 0; i < model.n_vertices(); ++i) {
    const Vec3 y = cloth.state.positions.col(i) + kStep * cloth.state.velocities.col(i) +
                   kStep * kStep * model.gravity;
    g.col(i) += model.masses[i] / (kStep * kStep) * (x.col(i) - y);
  }
  return Eigen::Map<const Eigen::VectorXd>(g.data(), g.size());
}

/// Backward Euler by Newton's method with a dense Jacobian by differences.
Positions newton_step(const Cloth& cloth) {
  const int n = cloth.model.n_vertices();
  Positions x_end = cloth.state.positions + kStep * cloth.state.velocities;
  const Pin& pin = cloth.model.pins[0];
  x_end.col(pin.vertex.value) = pin.position(kStep);
  Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(x_end.data(), x_end.size());
  for (int iteration = 0; iteration < 30; ++iteration) {
    Eigen::VectorXd g = gradient(cloth, x);
    Eigen::MatrixXd J(3 * n, 3 * n);
    constexpr double kStride = 1e-6;  // [m]
    for (Eigen::Index c = 0; c < J.cols(); ++c) {
      Eigen::VectorXd ahead = x, behind = x;
      ahead[c] += kStride;
      behind[c] -= kStride;
      J.col(c) = (gradient(cloth, ahead) - gradient(cloth, behind)) / (2 * kStride);
    }
    for (int k = 0; k < 3; ++k) {
      const Eigen::Index row = 3 * pin.vertex.value + k;
      J.row(row).setZero();
      J(row, row) = 1;
      g[row] = 0;
    }
    x -= J.partialPivLu().solve(g);
  }
  return Eigen::Map<const Positions>(x.data(), 3, n);
}

/// Fine cotton that hangs from its upper edge, as it is or stretched.
Cloth hanging_sheet(double stretch) {
  const QuadMesh mesh = square_sheet(12);
  Cloth cloth{sheet_model(mesh, library_fabric("fine cotton")), rest_state(mesh)};
  cloth.model.gravity = {0, -9.81, 0};
  cloth.state.positions *= stretch;
  for (int i = 0; i <= 12; ++i)
    cloth.model.pins.push_back({VertexId(i), cloth.state.positions.col(i), {}});
  return cloth;
}

/// Rounds until the residual is this small, in shares of the first one's.
int rounds_to(double residual, const Cloth& cloth, Acceleration acceleration) {
  constexpr int kMostRounds = 4096;
  for (int rounds = 1; rounds <= kMostRounds; ++rounds) {
    Cloth moved = cloth;
    const SolveReport report =
        make_stepper(moved.model, projective(rounds, acceleration))->advance(moved.state, 0);
    if (report.relative_residual < residual) return rounds;
  }
  return kMostRounds;
}

/// Sheet without weight, dampers and pins, three times as wide as at rest, of which every vertex
/// flies elsewhere.
Cloth torn_at_sheet() {
  const QuadMesh mesh = square_sheet(8);
  Cloth cloth{sheet_model(mesh, library_fabric("fine cotton")), rest_state(mesh)};
  for (Spring& spring : cloth.model.springs) spring.damping = 0;
  Random random(7);
  cloth.state.positions = shaken(3 * cloth.state.positions, 0.1, random);
  cloth.state.velocities = shaken(cloth.state.velocities, 30, random);
  return cloth;
}

/// |x - y|^2_M / (2 h^2) + E(x), of a cloth without dampers or weight [J].
double step_energy(const Cloth& cloth, const Positions& x) {
  const Positions ahead = cloth.state.positions + kStep * cloth.state.velocities;
  return elastic_energy(cloth.model, x) +
         ((x - ahead).colwise().squaredNorm() * cloth.model.masses).value() / (2 * kStep * kStep);
}

/// Holds that cloth which starts at its equilibrium stays there, whatever the rounds.
void check_that_it_stays(ClothModel& model, State& state) {
  const int rounds = GENERATE(1, 2, 10);
  const auto acceleration = GENERATE(Acceleration::none, Acceleration::anderson);
  CAPTURE(rounds, acceleration);
  const Positions start = state.positions;
  const auto stepper = make_stepper(model, projective(rounds, acceleration));
  for (int s = 0; s < 500; ++s) REQUIRE(stepper->advance(state, s * kStep).ok());
  CHECK((state.positions - start).cwiseAbs().maxCoeff() < 1e-10);
  CHECK(state.velocities.cwiseAbs().maxCoeff() < 1e-9);
}

}  // namespace

TEST_CASE("projective: cloth that only falls leaves nothing unsolved, near the origin or far",
          "[dynamics]") {
  const QuadMesh mesh = sheet_with_aspect(6, 6, 1.2);
  Cloth cloth{sheet_model(mesh, library_fabric("fine cotton")), rest_state(mesh)};
  const double distance = GENERATE(0, 1, 1000);
  CAPTURE(distance);
  cloth.state.positions.colwise() += Vec3(distance, distance, distance);
  const auto stepper = make_stepper(cloth.model, projective(10));
  for (int s = 0; s < 20; ++s)
    CHECK(stepper->advance(cloth.state, s * kStep).relative_residual < 0.2);
}

TEST_CASE("projective: many rounds reach the backward Euler step that Newton finds", "[dynamics]") {
  const auto direction = GENERATE(DampingDirection::along_spring, DampingDirection::isotropic);
  const auto acceleration = GENERATE(Acceleration::none, Acceleration::anderson);
  CAPTURE(acceleration);
  Cloth cloth = soft_sheet(direction);
  const Positions expected = newton_step(cloth);
  const Positions begin = cloth.state.positions;
  REQUIRE(make_stepper(cloth.model, projective(2000, acceleration))->advance(cloth.state, 0).ok());
  CHECK((cloth.state.positions - expected).norm() < 1e-9 * (expected - begin).norm());
}

TEST_CASE("projective: a weight on two springs stays where they balance, whatever the rounds",
          "[dynamics]") {
  ClothModel model = chain_model({2});
  const double weight = model.gravity.norm() * model.masses[1];
  const Spring& spring = model.springs[0];
  const double half_span = 0.9 * spring.rest_length;
  double above = 0, below = spring.rest_length;
  for (int halving = 0; halving < 60; ++halving) {
    const double sag = (above + below) / 2;
    const double length = std::hypot(half_span, sag);
    const double lift = 2 * spring.stiffness * (length - spring.rest_length) * sag / length;
    (lift < weight ? above : below) = sag;
  }
  State state{Positions::Zero(3, 3), Positions::Zero(3, 3)};
  state.positions.row(0) << 0, half_span, 2 * half_span;
  state.positions(1, 1) = -above;
  model.pins.push_back({VertexId(2), state.positions.col(2), {}});
  check_that_it_stays(model, state);
}

TEST_CASE("projective: a tip that bending holds up stays where they balance, whatever the rounds",
          "[dynamics]") {
  ClothModel model = chain_model({2});
  const double length = model.springs[0].rest_length;
  const double sag = 0.2 * length;
  const double stiffness = model.gravity.norm() * model.masses[2] / sag;
  State state{Positions::Zero(3, 3), Positions::Zero(3, 3)};
  state.positions.row(0) << 0, length, 2 * length;
  state.positions(1, 2) = -sag;
  model.springs[1].rest_length = std::hypot(length, sag);  // bending alone bears the weight
  model.bends.push_back({{VertexId(0), VertexId(1), VertexId(2)}, {1, -2, 1}, stiffness});
  model.pins.push_back({VertexId(1), state.positions.col(1), {}});
  check_that_it_stays(model, state);
}

TEST_CASE("projective: more rounds come nearer to the converged step", "[dynamics]") {
  const auto after = [](int rounds) {
    Cloth cloth = soft_sheet(DampingDirection::along_spring);
    const SolveReport report =
        make_stepper(cloth.model, projective(rounds))->advance(cloth.state, 0);
    REQUIRE(report.ok());
    return std::pair(cloth.state.positions, report.relative_residual);
  };
  const Positions converged = after(2000).first;
  double error = INFINITY;
  double residual = INFINITY;
  for (const int rounds : {1, 3, 10, 30, 100}) {
    CAPTURE(rounds);
    const auto [positions, reported] = after(rounds);
    CHECK((positions - converged).norm() < 0.8 * error);
    CHECK(reported < 0.8 * residual);
    error = (positions - converged).norm();
    residual = reported;
  }
}

TEST_CASE("projective: acceleration takes a third of the rounds to the same residual",
          "[dynamics]") {
  const double stretch = GENERATE(1.0, 1.02);
  CAPTURE(stretch);
  const int plain = rounds_to(1e-6, hanging_sheet(stretch), Acceleration::none);
  const int accelerated = rounds_to(1e-6, hanging_sheet(stretch), Acceleration::anderson);
  CAPTURE(plain, accelerated);
  CHECK(3 * accelerated < plain);
}

TEST_CASE("projective: no accelerated round raises the energy, and refused ones are counted",
          "[dynamics]") {
  const Cloth cloth = torn_at_sheet();
  const auto energy_after = [&](int rounds, Acceleration acceleration) {
    Cloth moved = cloth;
    StepperProjective stepper(moved.model, projective(rounds, acceleration));
    REQUIRE(stepper.advance(moved.state, 0).ok());
    return std::pair(step_energy(cloth, moved.state.positions), stepper.n_refused());
  };
  double least = INFINITY;
  int n_refused = 0;
  for (int rounds = 1; rounds <= 40; ++rounds) {
    CAPTURE(rounds);
    const auto [plain, none_refused] = energy_after(rounds, Acceleration::none);
    const auto [accelerated, refused] = energy_after(rounds, Acceleration::anderson);
    CHECK(accelerated < least);
    CHECK(accelerated <= plain);
    CHECK(none_refused == 0);
    CHECK(refused >= n_refused);
    least = accelerated;
    n_refused = refused;
  }
  CHECK(n_refused > 1);
}

TEST_CASE("projective: velocities are displacements over the step", "[dynamics]") {
  Cloth cloth = soft_sheet(DampingDirection::along_spring);
  const Positions begin = cloth.state.positions;
  REQUIRE(make_stepper(cloth.model, projective(5))->advance(cloth.state, 0).ok());
  CHECK((cloth.state.positions - begin - kStep * cloth.state.velocities).norm() < 1e-14);
}

TEST_CASE("projective: a solver that keeps no factor is refused", "[dynamics]") {
  Cloth cloth = soft_sheet(DampingDirection::along_spring);
  MethodOptions options = projective(1);
  options.solver = SolverKind::cg;
  CHECK_THROWS_AS(make_stepper(cloth.model, options), InputError);
}

}  // namespace pleat
