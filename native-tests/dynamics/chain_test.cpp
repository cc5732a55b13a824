#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "core/dynamics/stepper_table.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

/// How a mode moves: q ~ exp(-decay t) cos(omega t).
struct Swing {
  double omega = 0;  // [rad/s]
  double decay = 0;  // [1/s]
};

/// A damped cosine sampled every h obeys q_{n+1} = a q_n + b q_{n-1}; a and b by least squares, its
/// roots exp((-decay +- i omega) h).
Swing fitted_swing(const std::vector<double>& q, double h) {
  const auto n = static_cast<Eigen::Index>(q.size()) - 2;
  Eigen::MatrixX2d past(n, 2);
  Eigen::VectorXd next(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    past.row(i) << q[at + 1], q[at];
    next[i] = q[at + 2];
  }
  const Eigen::Vector2d fit = past.colPivHouseholderQr().solve(next);
  const std::complex<double> root =
      0.5 * (fit[0] + std::sqrt(std::complex<double>(fit[0] * fit[0] + 4 * fit[1])));
  return {std::abs(std::arg(root)) / h, -std::log(std::abs(root)) / h};
}

/// The swing that a first-order method makes of an undamped one of omega at steps of h.
Swing expected_swing(const StepperType* stepper, double omega, double h) {
  if (stepper == &steppers::kExplicitEuler) return {2 / h * std::asin(omega * h / 2), 0};
  // Backward Euler: root 1/(1 - i omega h).
  return {std::atan(omega * h) / h, std::log1p(omega * omega * h * h) / (2 * h)};
}

/// Follows the part of the motion along `mode` (3n, mass-normalised) from `start` for two periods.
Swing simulated_swing(const ClothModel& model_in, const MethodOptions& options, const State& rest,
                      const Positions& mode, double amplitude, double omega) {
  ClothModel model = model_in;
  State state = rest;
  state.positions += amplitude * mode;
  const auto stepper = make_stepper(model, options);
  const int n_steps = static_cast<int>(2 * 2 * kPi / (omega * options.step));
  std::vector<double> q;
  for (int s = 0; s < n_steps; ++s) {
    REQUIRE(stepper->advance(state, s * options.step).ok());
    const Positions moved = (state.positions - rest.positions) * model.masses.asDiagonal();
    q.push_back(moved.cwiseProduct(mode).sum());
  }
  return fitted_swing(q, options.step);
}

/// Modes of a tridiagonal chain fixed at its upper end: spring i of stiffness k_i between nodes i
/// and i + 1. Columns are mass-normalised, lowest first.
struct ChainModes {
  Eigen::VectorXd omegas;  // [rad/s]
  Eigen::MatrixXd shapes;  // rows leave out the fixed node
};

ChainModes chain_modes(const Eigen::VectorXd& stiffness, const Eigen::VectorXd& masses) {
  const Eigen::Index n = stiffness.size();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    K(i, i) += stiffness[i];
    if (i == 0) continue;
    K(i - 1, i - 1) += stiffness[i];
    K(i, i - 1) -= stiffness[i];
    K(i - 1, i) -= stiffness[i];
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      K, Eigen::MatrixXd(masses.asDiagonal()));
  return {solver.eigenvalues().cwiseSqrt(), solver.eigenvectors()};
}

/// Weight below each spring over its length: what a stretched spring resists sideways with [N/m].
Eigen::VectorXd sideways_stiffness(const Chain& chain) {
  Eigen::VectorXd stiffness(chain.n_springs);
  for (int i = 0; i < chain.n_springs; ++i) {
    const double tension = chain.mass * (chain.n_springs - i - 0.5) * chain.gravity;
    stiffness[i] = tension / (chain.length + tension / chain.stiffness);
  }
  return stiffness;
}

Positions mode_along(int axis, const Eigen::VectorXd& shape) {
  Positions mode = Positions::Zero(3, shape.size() + 1);
  mode.row(axis).tail(shape.size()) = shape.transpose();
  return mode;
}

/// Frequency and decay against the method's own on a linear swing, and the frequency against the
/// exact one within the square of omega h, the order of a first-order method's phase error. xpbd's
/// own sideways decay is smaller than backward Euler's (docs/methods/xpbd.md), and single precision
/// leaves it noise that the fit amplifies by 1/(omega h)^2.
void check_swing(const Swing& found, const StepperType* stepper, double omega, double h,
                 double tolerance) {
  const Swing expected = expected_swing(stepper, omega, h);
  CAPTURE(stepper->name, omega, h, found.omega, found.decay, expected.omega, expected.decay);
  if (stepper->is_single_precision) {
    constexpr double kNoise = 1e-3;
    CHECK(found.omega == Approx(omega).epsilon(omega * omega * h * h + kNoise));
    CHECK(found.decay < expected.decay + kNoise * omega);
    CHECK(found.decay > -kNoise * omega);
    return;
  }
  CHECK(found.omega == Approx(omega).epsilon(omega * omega * h * h + tolerance));
  CHECK(found.omega == Approx(expected.omega).epsilon(tolerance));
  CHECK(std::abs(found.decay - expected.decay) < tolerance * omega);
}

}  // namespace

TEST_CASE("chain: a weight on a spring bounces with sqrt(k/m)", "[dynamics]") {
  const double steps_per_radian = GENERATE(50.0, 200.0);
  const Chain chain{1, 200, 0.5, 1, 9.81, 0};
  const double omega = std::sqrt(chain.stiffness / (chain.mass / 2));
  for (const MethodOptions& options : converged_methods(1 / (omega * steps_per_radian))) {
    // Hooke's law is linear along the spring: any amplitude will do.
    Positions mode = Positions::Zero(3, 2);
    mode(1, 1) = 1;
    const Swing found =
        simulated_swing(chain_model(chain), options, hanging_state(chain), mode, 0.02, omega);
    check_swing(found, options.stepper, omega, options.step, 1e-8);
  }
}

TEST_CASE("chain: a weight on a spring swings sideways with sqrt(g/l), l stretched", "[dynamics]") {
  const Chain chain{1, 200, 0.5, 1, 9.81, 0};
  const double length = chain.length + chain.mass / 2 * chain.gravity / chain.stiffness;
  const double omega = std::sqrt(chain.gravity / length);
  for (const MethodOptions& options : converged_methods(0.005)) {
    Positions mode = Positions::Zero(3, 2);
    mode(0, 1) = 1;
    constexpr double kAngle = 0.01;  // makes the swing slower by kAngle^2 / 16
    const Swing found = simulated_swing(chain_model(chain), options, hanging_state(chain), mode,
                                        kAngle * length, omega);
    check_swing(found, options.stepper, omega, options.step, kAngle * kAngle);
  }
}

TEST_CASE("chain: it hangs still where every spring carries the weight below it", "[dynamics]") {
  Chain chain;
  chain.n_springs = GENERATE(1, 4, 16);
  CAPTURE(chain.n_springs);
  const State hanging = hanging_state(chain);
  for (const MethodOptions& options : converged_methods(0.002)) {
    CAPTURE(options.stepper->name);
    ClothModel model = chain_model(chain);
    State state = hanging;
    const auto stepper = make_stepper(model, options);
    for (int s = 0; s < 100; ++s) REQUIRE(stepper->advance(state, s * options.step).ok());
    const double rounding = options.stepper->is_single_precision ? 1e-6 : 1e-12;  // float32
    CHECK((state.positions - hanging.positions).norm() < rounding * chain.n_springs);
  }
}

TEST_CASE("chain: damped, it comes to rest at the elongation under its own weight", "[dynamics]") {
  // n springs with weights m, the last m/2: n^2 m g / (2 k) in all.
  Chain chain;
  chain.n_springs = GENERATE(1, 6);
  const double k_over_m = chain.stiffness / chain.mass;
  const double slowest = 2 * std::sqrt(k_over_m) * std::sin(kPi / (4 * chain.n_springs));
  chain.relaxation = 2 / slowest;  // critical for the slowest mode
  const double n = chain.n_springs;
  const double elongation = n * n * chain.mass * chain.gravity / (2 * chain.stiffness);
  for (MethodOptions options : converged_methods(0.01)) {
    CAPTURE(options.stepper->name, chain.n_springs);
    if (options.stepper == &steppers::kExplicitEuler) options.substeps = 0;
    ClothModel model = chain_model(chain);
    State state{Positions::Zero(3, chain.n_springs + 1), Positions::Zero(3, chain.n_springs + 1)};
    for (int i = 0; i <= chain.n_springs; ++i) state.positions(1, i) = -i * chain.length;
    const auto stepper = make_stepper(model, options);
    // Backward Euler shrinks the critically damped mode by 1 + omega h per step: e^-40 is left.
    const int n_steps = static_cast<int>(40 / std::log1p(slowest * options.step));
    for (int s = 0; s < n_steps; ++s) REQUIRE(stepper->advance(state, s * options.step).ok());
    const double found = -state.positions(1, chain.n_springs) - n * chain.length;
    CHECK(found == Approx(elongation).epsilon(options.stepper->is_single_precision ? 1e-4 : 1e-9));
  }
}

TEST_CASE("chain: its two lowest bouncing modes have their closed-form frequencies", "[dynamics]") {
  const int mode_number = GENERATE(1, 2);
  const Chain chain;
  const double omega = 2 * std::sqrt(chain.stiffness / chain.mass) *
                       std::sin((2 * mode_number - 1) * kPi / (4 * chain.n_springs));
  const ClothModel model = chain_model(chain);
  const ChainModes modes = chain_modes(Eigen::VectorXd::Constant(chain.n_springs, chain.stiffness),
                                       model.masses.tail(chain.n_springs));
  REQUIRE(modes.omegas[mode_number - 1] == Approx(omega).epsilon(1e-12));
  const Positions shape = mode_along(1, modes.shapes.col(mode_number - 1));
  for (const MethodOptions& options : converged_methods(0.02 / omega)) {
    const Swing found = simulated_swing(model, options, hanging_state(chain), shape,
                                        0.01 / shape.cwiseAbs().maxCoeff(), omega);
    check_swing(found, options.stepper, omega, options.step, 1e-7);
  }
}

TEST_CASE("chain: its two lowest swinging modes are those of a string under its own tension",
          "[dynamics]") {
  const int mode_number = GENERATE(1, 2);
  const Chain chain;
  const ClothModel model = chain_model(chain);
  const ChainModes modes =
      chain_modes(sideways_stiffness(chain), model.masses.tail(chain.n_springs));
  const double omega = modes.omegas[mode_number - 1];
  const Positions shape = mode_along(0, modes.shapes.col(mode_number - 1));
  for (const MethodOptions& options : converged_methods(0.02 / omega)) {
    // A slope s changes tension and frequency by about s^2, here 1e-4.
    const Swing found = simulated_swing(model, options, hanging_state(chain), shape,
                                        0.001 / shape.cwiseAbs().maxCoeff(), omega);
    check_swing(found, options.stepper, omega, options.step, 1e-4);
  }
}

TEST_CASE("chain: the lowest swing of a long one is that of a heavy rope", "[dynamics]") {
  // omega = 2.404826 / 2 sqrt(g/l), half the first zero of the Bessel function J0; the chain of n
  // links with half a mass at its end comes to it as 1/n^2.
  double errors[2];
  for (int k = 0; k < 2; ++k) {
    Chain chain;
    chain.n_springs = 8 << k;
    chain.length = 1.0 / chain.n_springs;
    chain.stiffness = 1e9;
    const ChainModes modes =
        chain_modes(sideways_stiffness(chain), chain_model(chain).masses.tail(chain.n_springs));
    errors[k] = std::abs(modes.omegas[0] - 0.5 * 2.404825557695773 * std::sqrt(9.81));
  }
  CHECK(errors[0] / errors[1] == Approx(4).epsilon(0.1));
}

}  // namespace pleat
