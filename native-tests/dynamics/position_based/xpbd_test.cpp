#include "core/dynamics/position_based/lanes/bend_program.h"
#include "core/dynamics/position_based/lanes/spring_program.h"
#include "core/dynamics/position_based/stepper_position_based.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "core/base/random.h"
#include "core/model/momentum.h"
#include "native-tests/support/allocation_count.h"
#include "native-tests/support/particle.h"

namespace pleat {
namespace {

MethodOptions xpbd_options(int substeps, int iterations = 1) {
  MethodOptions options;
  options.stepper = &steppers::kXpbd;
  options.substeps = substeps;
  options.iterations = iterations;
  return options;
}

MethodOptions rigid_options(int substeps) {
  MethodOptions options = xpbd_options(substeps);
  options.constraints = Constraints::rigid;
  return options;
}

struct System {
  ClothModel model;
  State state;
};

Spring spring_between(const Positions& positions, int a, int b, double stiffness, double damping) {
  Spring spring;
  spring.a = VertexId(a);
  spring.b = VertexId(b);
  spring.stiffness = stiffness;
  spring.damping = damping;
  spring.rest_length = (positions.col(a) - positions.col(b)).norm();
  return spring;
}

void pin(System& system, int vertex) {
  Pin held;
  held.vertex = VertexId(vertex);
  held.place = system.state.positions.col(vertex);
  system.model.pins.push_back(held);
}

System particles(const Positions& positions) {
  System system;
  system.state.positions = positions;
  system.state.velocities.setZero(3, positions.cols());
  system.model.masses = Eigen::VectorXd::Constant(positions.cols(), 0.01);
  return system;
}

/// n x n vertices, 1 m x 1 m, rows along x from the upper edge in direction `down`; springs on
/// edges and diagonals, vertices numbered by `numbers`.
System sheet(int n, const Vec3& down, const std::vector<int>& numbers) {
  const double cell = 1.0 / (n - 1);
  Positions positions(3, n * n);
  RestCoordinates rest(2, n * n);
  const auto vertex = [&](int r, int c) { return numbers[static_cast<std::size_t>(r * n + c)]; };
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      positions.col(vertex(r, c)) = Vec3(c * cell, 0, 0) + r * cell * down;
      rest.col(vertex(r, c)) << r * cell, c * cell;
    }
  System system = particles(positions);
  system.model.masses.setConstant(0.2 / (n * n));
  system.model.rest_coordinates = rest;
  const auto join = [&](int a, int b) {
    system.model.springs.push_back(spring_between(positions, a, b, 1000, 0));
  };
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      if (r + 1 < n) join(vertex(r, c), vertex(r + 1, c));
      if (c + 1 < n) join(vertex(r, c), vertex(r, c + 1));
      if (r + 1 == n || c + 1 == n) continue;
      join(vertex(r, c), vertex(r + 1, c + 1));
      join(vertex(r, c + 1), vertex(r + 1, c));
    }
  return system;
}

std::vector<int> ascending(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

template <class Value>
void shuffle(std::vector<Value>& values, Random& random) {
  for (std::size_t i = values.size(); i > 1; --i)
    std::swap(values[i - 1],
              values[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(i)))]);
}

System swinging_sheet(int n) {
  System system = sheet(n, {0, 0, 1}, ascending(n * n));
  for (int c = 0; c < n; ++c) pin(system, c);
  return system;
}

/// Curvature (x0 - 2 x1 + x2)/arm^2 of vertices first, first + stride, first + 2 stride.
BendElement bend_of(int first, int stride, double arm, double stiffness) {
  BendElement bend;
  bend.vertices = {VertexId(first), VertexId(first + stride), VertexId(first + 2 * stride)};
  const double weight = 1 / (arm * arm);
  bend.weights = {weight, -2 * weight, weight};
  bend.stiffness = stiffness;
  return bend;
}

void add_bends(System& system, int n, double stiffness) {
  const double cell = 1.0 / (n - 1);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      if (c + 2 < n) system.model.bends.push_back(bend_of(r * n + c, 1, cell, stiffness));
      if (r + 2 < n) system.model.bends.push_back(bend_of(r * n + c, n, cell, stiffness));
    }
}

void advance(Stepper& stepper, State& state, int n_steps) {
  for (int step = 0; step < n_steps; ++step) {
    const SolveReport report = stepper.advance(state, step * stepper.options().step);
    INFO(report.message);
    REQUIRE(report.ok());
  }
}

/// Two vertices, the lower one free; k = 40 N/m, 0.01 kg, omega = 63.2 rad/s.
System hanging_spring(double damping) {
  Positions positions(3, 2);
  positions << 0, 0, 0, -1, 0, 0;
  System system = particles(positions);
  system.model.springs.push_back(spring_between(positions, 0, 1, 40, damping));
  pin(system, 0);
  return system;
}

}  // namespace

TEST_CASE("xpbd: a hanging spring sags by m g / k whatever the iterations", "[dynamics]") {
  const int iterations = GENERATE(1, 2, 7);
  const bool isotropic = GENERATE(false, true);
  CAPTURE(iterations, isotropic);
  System system = hanging_spring(0.5);
  if (isotropic) system.model.damping_direction = DampingDirection::isotropic;
  StepperPositionBased stepper(system.model, xpbd_options(20, iterations));
  advance(stepper, system.state, 180);
  const double sag = -1 - system.state.positions(1, 1);
  CHECK(sag == Approx(0.01 * 9.81 / 40).epsilon(1e-3));
}

TEST_CASE("xpbd: an oscillating spring tends to the damped oscillator at first order",
          "[dynamics]") {
  const double damping = GENERATE(0.0, 0.1);
  const bool isotropic = GENERATE(false, true);
  CAPTURE(damping, isotropic);
  const double amplitude = 0.05;
  const double decay = damping / (2 * 0.01);
  const double omega = std::sqrt(40 / 0.01 - decay * decay);
  const double time = 6.0 / 60;
  const double exact = amplitude * std::exp(-decay * time) *
                       (std::cos(omega * time) + decay / omega * std::sin(omega * time));
  std::vector<double> errors;
  for (int substeps : {20, 40, 80}) {
    System system = hanging_spring(damping);
    if (isotropic) system.model.damping_direction = DampingDirection::isotropic;
    system.model.gravity.setZero();
    system.state.positions(1, 1) -= amplitude;
    StepperPositionBased stepper(system.model, xpbd_options(substeps));
    advance(stepper, system.state, 6);
    errors.push_back(std::abs(-1 - system.state.positions(1, 1) - exact));
  }
  CAPTURE(errors);
  CHECK(std::log2(errors[0] / errors[1]) == Approx(1).margin(0.25));
  CHECK(std::log2(errors[1] / errors[2]) == Approx(1).margin(0.15));
}

TEST_CASE("xpbd: a bending element holds a load at its closed-form deflection", "[dynamics]") {
  const int iterations = GENERATE(1, 3);
  CAPTURE(iterations);
  Positions positions(3, 3);
  positions << 0, 0.1, 0.2, 0, 0, 0, 0, 0, 0;
  System system = particles(positions);
  const double arm = 0.1;
  const double stiffness = 2e-3;  // [N m^3]
  system.model.bends.push_back(bend_of(0, 1, arm, stiffness));
  pin(system, 0);
  pin(system, 1);
  StepperPositionBased stepper(system.model, xpbd_options(4, iterations));
  advance(stepper, system.state, 600);
  const double deflection = 0.01 * 9.81 * std::pow(arm, 4) / stiffness;
  CHECK(-system.state.positions(1, 2) == Approx(deflection).epsilon(1e-3));
  CHECK(std::abs(system.state.positions(0, 2) - 0.2) < 1e-6);
}

TEST_CASE("xpbd: free fall is exact to rounding however small the substep", "[dynamics]") {
  const int substeps = GENERATE(1, 30, 1000);
  CAPTURE(substeps);
  System system = particles(Positions::Constant(3, 2, 0.7));
  system.state.positions.col(1).setConstant(-0.7);
  StepperPositionBased stepper(system.model, rigid_options(substeps));
  advance(stepper, system.state, 60);
  const double h = 1.0 / 60 / substeps;
  // g h^2 is added to a move of up to v h, v = g * 1 s, and rounded to its last bit.
  const double rounding = std::pow(2.0, -24) / h;
  const double fallen = 0.7 - system.state.positions(1, 0);
  CHECK(system.state.velocities(1, 0) == Approx(-9.81).epsilon(rounding));
  CHECK(fallen == Approx(0.5 * 9.81 * (1 + h)).epsilon(rounding));  // symplectic Euler's sum
}

TEST_CASE("xpbd: slow motion is not lost in rounding", "[dynamics]") {
  System system = particles(Positions::Constant(3, 2, 0.7));
  system.state.positions.col(1).setConstant(-0.7);
  system.model.gravity.setZero();
  const double speed = 1e-5;  // [m/s]: a substep's move is a fortieth of the last bit of a position
  system.state.velocities(0, 0) = speed;
  const double start = system.state.positions(0, 0);
  StepperPositionBased stepper(system.model, rigid_options(100));
  advance(stepper, system.state, 60);
  CHECK(system.state.positions(0, 0) - start == Approx(speed).epsilon(1e-3));
}

TEST_CASE("xpbd: only the isotropic damper brakes motion across a spring", "[dynamics]") {
  const bool isotropic = GENERATE(false, true);
  CAPTURE(isotropic);
  Positions positions(3, 2);
  positions << 0, 0, 0, -1, 0, 0;
  System system = particles(positions);
  system.model.gravity.setZero();
  if (isotropic) system.model.damping_direction = DampingDirection::isotropic;
  const double damping = 0.1;  // [N s/m]
  system.model.springs.push_back(spring_between(positions, 0, 1, 40, damping));
  const double speed = 1e-3;  // too slow to turn the spring
  system.state.velocities(0, 0) = speed;
  system.state.velocities(0, 1) = -speed;
  StepperPositionBased stepper(system.model, xpbd_options(100));
  advance(stepper, system.state, 3);
  const double rate = isotropic ? damping / (0.5 * 0.01) : 0;  // c over the reduced mass [1/s]
  CHECK(system.state.velocities(0, 0) == Approx(speed * std::exp(-rate * 3 / 60)).epsilon(5e-3));
}

TEST_CASE("xpbd: projections keep momentum", "[dynamics]") {
  const std::uint64_t seed = GENERATE(1u, 2u, 3u);
  const bool rigid = GENERATE(false, true);
  CAPTURE(seed, rigid);
  const int n = 9;
  Random random(seed);
  System system = sheet(n, {0, 0, 1}, ascending(n * n));
  add_bends(system, n, 1e-6);
  system.model.gravity.setZero();
  for (double& x : system.state.velocities.reshaped()) x = random.uniform(-1, 1);
  for (double& mass : system.model.masses) mass *= random.uniform(0.5, 2);
  const Vec3 before = momentum(system.model, system.state);
  StepperPositionBased stepper(system.model, rigid ? rigid_options(20) : xpbd_options(20));
  advance(stepper, system.state, 30);
  // Each substep rounds every position off by at most 2^-25 m, which h = 1/1200 s turns into
  // velocity; over 600 substeps and 12 constraints each the errors of 81 vertices add up like a
  // random walk.
  const double noise = std::pow(2.0, -25) * 1200 * std::sqrt(600.0 * 12 * n * n) / (n * n);
  CHECK((momentum(system.model, system.state) - before).norm() <
        3 * noise * system.model.masses.sum());
}

TEST_CASE("xpbd: pins are where their motion puts them, to the bit", "[dynamics]") {
  System system = swinging_sheet(9);
  for (Pin& held : system.model.pins) {
    held.motion.kind = Motion::Kind::oscillate;
    held.motion.offset = {0.1, 0.2, 0.3};
    held.motion.frequency = 1.7;
  }
  StepperPositionBased stepper(system.model, rigid_options(10));
  advance(stepper, system.state, 7);
  const double time = 6 * stepper.options().step + stepper.options().step;
  for (const Pin& held : system.model.pins) {
    const Vec3 place = system.state.positions.col(held.vertex.value);
    CHECK(place == held.position(time));
  }
}

// Fixed vertices are placed once a step, moving ones in every substep.
TEST_CASE("xpbd: a pin that holds is one that moves nowhere, in air too, to the bit",
          "[dynamics]") {
  const auto after = [](Motion::Kind kind) {
    System system = particles((Positions(3, 3) << 0, 1, 0, 0, 0, 0, 0, 0, 1).finished());
    for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {0, 2}})
      system.model.springs.push_back(spring_between(system.state.positions, a, b, 50, 0.01));
    const std::vector<Triangle> triangles{{VertexId(0), VertexId(1), VertexId(2)}};
    AirOptions thick;
    thick.density = 100;
    system.model.air.emplace(triangles, thick, system.model.n_vertices());
    pin(system, 0);
    system.model.pins[0].motion.kind = kind;
    StepperPositionBased stepper(system.model, xpbd_options(20));
    advance(stepper, system.state, 30);
    return system.state.positions;
  };
  const Positions held = after(Motion::Kind::hold);
  CHECK((held.col(1) - Vec3(1, 0, 0)).norm() > 1e-3);
  CHECK(held == after(Motion::Kind::oscillate));
}

/// A triangle that falls flat for half a second; its speed where it began with `speed` [m/s].
double falls(double density, double speed, int substeps) {
  System system = particles((Positions(3, 3) << 0, 1, 0, 0, 0, 0, 0, 0, 1).finished());
  AirOptions air;
  air.density = density;
  system.model.air.emplace(std::vector<Triangle>{{VertexId(0), VertexId(1), VertexId(2)}}, air,
                           system.model.n_vertices());
  system.state.velocities.row(1).setConstant(-speed);
  StepperPositionBased stepper(system.model, xpbd_options(substeps));
  advance(stepper, system.state, 30);
  return -system.state.velocities(1, 1);
}

TEST_CASE("xpbd: in air it falls as the closed form says, and drag never turns it round",
          "[dynamics]") {
  const int substeps = GENERATE(1, 10);
  const double mass = particles(Positions::Zero(3, 3)).model.masses.sum();
  constexpr double kDensity = 1.2;
  const double terminal = std::sqrt(mass * 9.81 / (0.5 * kDensity * 0.5));  // area 1/2, C_n 1
  CHECK(falls(kDensity, 0, substeps) ==
        Approx(terminal * std::tanh(9.81 * 0.5 / terminal)).epsilon(0.02));
  const double in_mud = std::sqrt(mass * 9.81 / (0.5 * 1e6 * 0.5));
  CHECK(falls(1e6, 10, substeps) == Approx(in_mud).epsilon(0.1));
}

TEST_CASE("xpbd: the same input gives the same bits", "[dynamics]") {
  const int n = GENERATE(5, 17, 22);
  CAPTURE(n);
  State ends[2];
  for (State& end : ends) {
    System system = swinging_sheet(n);
    add_bends(system, n, 1e-7);
    StepperPositionBased stepper(system.model, xpbd_options(20, 2));
    advance(stepper, system.state, 20);
    end = system.state;
  }
  CHECK(ends[0].positions == ends[1].positions);
  CHECK(ends[0].velocities == ends[1].velocities);
}

TEST_CASE("xpbd: nothing is allocated after the first step", "[dynamics]") {
  if (!counts_allocations()) return;
  const bool rigid = GENERATE(false, true);
  System system = swinging_sheet(17);
  add_bends(system, 17, 1e-7);
  std::vector<Triangle> triangles{{VertexId(0), VertexId(1), VertexId(17)}};
  system.model.air.emplace(triangles, AirOptions{}, system.model.n_vertices());
  system.model.contact.emplace(std::vector<Collider>{{Plane{{0, -0.3, 0}, {0, 1, 0}}, {}, 0.3}},
                               ContactOptions{});
  StepperPositionBased stepper(system.model, rigid ? rigid_options(10) : xpbd_options(10, 2));
  stepper.advance(system.state, 0);
  CHECK(allocations_in([&] {
          for (int step = 1; step < 5; ++step) stepper.advance(system.state, step / 60.0);
          stepper.refresh_rest_lengths();
        }) == 0);
}

TEST_CASE("xpbd: four lanes together give what they give one by one, to the bit", "[dynamics]") {
  const int n = GENERATE(2, 4, 9, 14);
  const SpringLaw law = GENERATE(SpringLaw::rigid, SpringLaw::elastic);
  const bool shuffled = GENERATE(false, true);
  CAPTURE(n, static_cast<int>(law), shuffled);
  Random random(7);
  std::vector<int> numbers = ascending(n * n);
  if (shuffled) shuffle(numbers, random);
  System system = sheet(n, {0, 0, 1}, numbers);
  if (!shuffled) add_bends(system, n, 1e-6);
  const LaneLayout layout = lane_layout(system.model);
  std::vector<float> ends[2];
  for (std::vector<float>& end : ends) {
    SpringProgram springs(system.model, layout, law, 1e-3);
    BendProgram bends(system.model, layout, 1e-3);
    if (&end == &ends[1]) {
      springs.compute_lane_by_lane();
      bends.compute_lane_by_lane();
    }
    const auto size = static_cast<std::size_t>(layout.n_slots);
    std::vector<float> data(7 * size, 0.0f);
    Random noise(11);
    for (int i = 0; i < n * n; ++i) {
      const auto slot = static_cast<std::size_t>(layout.places[static_cast<std::size_t>(i)].slot);
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = system.state.positions(static_cast<Eigen::Index>(k), i);
        data[k * size + slot] = static_cast<float>(noise.uniform(-0.02, 0.02) / n);
        data[(3 + k) * size + slot] = static_cast<float>(x);
      }
      data[6 * size + slot] = i % 5 == 0 ? 0.0f : static_cast<float>(noise.uniform(0.5, 2));
    }
    const LaneView view{{&data[0], &data[size], &data[2 * size]},
                        {&data[3 * size], &data[4 * size], &data[5 * size]},
                        &data[6 * size]};
    springs.forget();
    bends.refresh_pins(view.inverse_masses);
    bends.forget();
    const double before = springs.squared_residual(view) + bends.squared_residual(view);
    for (int sweep = 0; sweep <= 20; ++sweep) {
      bends.sweep(view, sweep == 0 ? Multipliers::begun : Multipliers::kept);
      springs.sweep(view, sweep == 0);
    }
    CHECK(springs.squared_residual(view) + bends.squared_residual(view) < before);
    end.assign(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(3 * size));
  }
  CHECK(ends[0] == ends[1]);
}

TEST_CASE("xpbd: a regular sheet fills its lanes", "[dynamics]") {
  const int n = GENERATE(33, 65);
  CAPTURE(n);
  const System system = swinging_sheet(n);
  const LaneLayout layout = lane_layout(system.model);
  const SpringProgram program(system.model, layout, SpringLaw::rigid, 1e-3);
  const auto n_springs = static_cast<double>(system.model.springs.size());
  CHECK(n_springs / static_cast<double>(4 * program.n_operations()) > 0.88);
  CHECK(program.n_blocks() < 40);
}

TEST_CASE("xpbd: a hanging sheet at rest stays at rest in any order", "[dynamics]") {
  struct Case {
    int n, substeps, seconds;
  };
  const Case c = GENERATE(Case{33, 30, 10}, Case{65, 100, 2});
  const std::uint64_t seed = GENERATE(1u, 2u, 3u);
  if (c.n == 65 && seed > 1) return;
  CAPTURE(c.n, c.substeps, seed);
  Random random(seed);
  std::vector<int> numbers = ascending(c.n * c.n);
  shuffle(numbers, random);
  System system = sheet(c.n, {0, -1, 0}, numbers);
  shuffle(system.model.springs, random);
  // Out of the axes' planes, where rounding can push it out of its own plane.
  const double turn = random.uniform(0.2, 1.4);
  const Mat3 rotation = Eigen::AngleAxisd(turn, Vec3(0, 1, 0)).toRotationMatrix();
  system.state.positions = (rotation * system.state.positions).eval();
  for (int column = 0; column < c.n; ++column)
    pin(system, numbers[static_cast<std::size_t>(column)]);
  const Positions start = system.state.positions;
  StepperPositionBased stepper(system.model, rigid_options(c.substeps));
  const double h = 1.0 / 60 / c.substeps;
  // Each of n - 1 links is placed to 2^-24 of its length, in the worst case all to the same side,
  // and the substep before likewise.
  const double fastest = 2 * std::pow(2.0, -24) / h;
  for (int step = 0; step < 60 * c.seconds; ++step) {
    REQUIRE(stepper.advance(system.state, step / 60.0).ok());
    REQUIRE(system.state.velocities.colwise().norm().maxCoeff() < fastest);
  }
  // Lines give way by a thousandth of g h^2 per link below, and links above add up.
  const double sag = 1e-3 * 9.81 * h * h * c.n * c.n;
  CHECK((system.state.positions - start).row(1).cwiseAbs().maxCoeff() < 1.2 * sag);
  CHECK((system.state.positions - start).colwise().norm().maxCoeff() < 1e-4);
}

TEST_CASE("xpbd: a swinging sheet keeps its lengths at every resolution", "[dynamics]") {
  const int n = GENERATE(17, 33, 65);
  CAPTURE(n);
  System system = swinging_sheet(n);
  StepperPositionBased stepper(system.model, rigid_options(20));
  advance(stepper, system.state, 20);
  double largest = 0;
  for (const Spring& spring : system.model.springs) {
    const double length =
        (system.state.positions.col(spring.a) - system.state.positions.col(spring.b)).norm();
    largest = std::max(largest, std::abs(length / spring.rest_length - 1));
  }
  CHECK(largest < 5e-4);
}

TEST_CASE("xpbd: a sheet pulled beyond its size by both edges stays bounded", "[dynamics]") {
  const bool rigid = GENERATE(false, true);
  CAPTURE(rigid);
  const int n = 17;
  System system = swinging_sheet(n);
  for (int c = 0; c < n; ++c) {
    pin(system, n * (n - 1) + c);
    Motion& motion = system.model.pins.back().motion;
    motion.kind = Motion::Kind::ease;
    motion.offset = {0, 0, 0.3};
    motion.time_end = 0.5;
  }
  StepperPositionBased stepper(system.model, rigid ? rigid_options(20) : xpbd_options(20));
  advance(stepper, system.state, 120);
  CHECK(system.state.positions.cwiseAbs().maxCoeff() < 2);
}

TEST_CASE("xpbd: any graph of springs stays finite", "[dynamics]") {
  const std::uint64_t seed = GENERATE(1u, 2u, 3u, 4u);
  const bool rigid = GENERATE(false, true);
  const int n = GENERATE(2, 3, 7, 40);
  CAPTURE(seed, rigid, n);
  Random random(seed);
  Positions positions(3, n);
  for (double& x : positions.reshaped()) x = random.uniform(-1, 1);
  positions.col(1) = positions.col(0);  // a spring of zero length
  System system = particles(positions);
  system.model.springs.push_back(spring_between(positions, 0, 1, 100, 0.1));
  for (int s = 0; s < 3 * n; ++s) {
    const auto a = static_cast<int>(random.below(n));
    const auto b = static_cast<int>(random.below(n));
    if (a == b) continue;
    system.model.springs.push_back(spring_between(positions, a, b, 100, 0.1));
    if (s % 3 == 0) system.model.springs.back().rest_length *= random.uniform(0, 2);
  }
  pin(system, 0);
  StepperPositionBased stepper(system.model, rigid ? rigid_options(5) : xpbd_options(5));
  advance(stepper, system.state, 120);
  CHECK(system.state.positions.cwiseAbs().maxCoeff() < 100);
}

TEST_CASE("xpbd: a vertex falling on a plane comes to lie on it", "[dynamics]") {
  Positions positions(3, 2);
  positions << 0, 0.1, 0.5, 0.5, 0, 0;
  System system = particles(positions);
  system.model.springs.push_back(spring_between(positions, 0, 1, 100, 0.1));
  system.model.contact.emplace(std::vector<Collider>{{Plane{}, {}, 0.3}}, ContactOptions{});
  StepperPositionBased stepper(system.model, rigid_options(10));
  for (int step = 0; step < 60; ++step) {
    stepper.advance(system.state, step / 60.0);
    REQUIRE(system.state.positions.row(1).minCoeff() > -1e-12);
  }
  CHECK(system.state.positions.row(1).maxCoeff() < 1e-6);
}

/// One particle on a slope of 30 degrees, at rest; how far it has come down after `seconds` [m].
double slide(const SolidShape& slope, double friction, const Vec3& place, double seconds) {
  System system = particles(place);
  system.model.contact.emplace(std::vector<Collider>{{slope, {}, friction}}, ContactOptions{});
  StepperPositionBased stepper(system.model, rigid_options(30));
  advance(stepper, system.state, static_cast<int>(std::lround(60 * seconds)));
  return (system.state.positions.col(0) - place).norm();
}

TEST_CASE("xpbd: friction holds on a slope or slides as Coulomb says", "[dynamics]") {
  const double angle = 3.14159265358979 / 6;
  const Vec3 normal(std::sin(angle), std::cos(angle), 0);
  const Plane plane{Vec3(0.3, -0.2, 0.1), normal};
  constexpr double kTime = 0.5;
  const double weight = 9.81;
  for (const double friction : {0.0, 0.2, 0.4}) {
    const double acceleration = weight * (std::sin(angle) - friction * std::cos(angle));
    const double expected = acceleration * kTime * kTime / 2;
    // Equal to first order in the substep.
    CHECK(slide(plane, friction, plane.point, kTime) == Approx(expected).epsilon(0.003));
  }
  CHECK(slide(plane, 0.7, plane.point, 5) < 1e-6);
  const Sphere ball{Vec3(0.3, -0.2, 0.1), 0.25};
  const Vec3 on_ball = ball.centre + ball.radius * normal;
  CHECK(slide(ball, 0.7, on_ball, 5) < 1e-6);
  CHECK(slide(ball, 0.4, on_ball, 0.2) > 0.01);
}

// Fast enough to fly through what is thin.
TEST_CASE("xpbd: nothing that is thrown at moving solids gets into them", "[dynamics]") {
  Random random(29);
  constexpr int kParticles = 333;
  const Vec3 middle(0.3, 0.2, -0.1);
  Positions positions(3, kParticles);
  for (int i = 0; i < kParticles; ++i)
    positions.col(i) = middle + random.uniform(0.6, 1.2) * random_direction(random);
  System system = particles(positions);
  for (int i = 0; i < kParticles; ++i)
    system.state.velocities.col(i) = 20 * (middle - positions.col(i)) + random_direction(random);
  Collider limb{
      RoundedCone{middle - Vec3(0.4, 0, 0), middle + Vec3(0.4, 0.1, 0), 0.05, 0.02}, {}, 0.3};
  limb.motion = turning_motion({0, 3, 1}, {0.5, 0, 0});
  Collider ball{Sphere{middle + Vec3(0, 0, 0.5), 0.2}, {}, 0.3};
  ball.motion = steady_motion({0, 0.4, 0});
  system.model.contact.emplace(
      std::vector<Collider>{{Plane{middle - Vec3(0, 0.8, 0)}, {}, 0.3}, limb, ball},
      ContactOptions{0.001, {}});
  StepperPositionBased stepper(system.model, rigid_options(3));
  std::vector<char> was_stopped(kParticles, 0);
  for (int step = 0; step < 30; ++step) {
    const Positions before = system.state.velocities;
    stepper.advance(system.state, step / 60.0);
    const Penetration inside =
        system.model.contact->penetration(system.state.positions, (step + 1) / 60.0);
    REQUIRE(inside.n_inside == 0);
    for (int i = 0; i < kParticles; ++i)
      if ((system.state.velocities.col(i) - before.col(i)).norm() > 1)
        was_stopped[static_cast<std::size_t>(i)] = 1;
  }
  CHECK(std::count(was_stopped.begin(), was_stopped.end(), 1) > kParticles / 2);
}

}  // namespace pleat
