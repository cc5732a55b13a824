// Closed forms that tests compare with.
#pragma once

#include <array>
#include <cmath>

namespace pleat {

constexpr double kPi = 3.141592653589793;

/// The first zeros of the Bessel function J0.
constexpr std::array<double, 3> kBesselZeros = {2.404825557695773, 5.520078110286311,
                                                8.653727912911013};

/// Period of a rigid pendulum that swings to `amplitude` [rad, below pi] on both sides [s]: 2 pi
/// sqrt(l/g) over the arithmetic-geometric mean of 1 and cos(amplitude/2) (Gauss).
inline double pendulum_period(double length, double gravity, double amplitude) {
  double a = 1;
  double b = std::cos(amplitude / 2);
  while (std::abs(a - b) > 1e-15) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return 2 * kPi * std::sqrt(length / gravity) / a;
}

/// Angular frequency of swing number `mode` (from 0) of a limp inextensible chain that hangs from
/// one end [rad/s].
inline double hanging_chain_omega(double length, double gravity, std::size_t mode) {
  return kBesselZeros.at(mode) / 2 * std::sqrt(gravity / length);
}

/// Angular frequency of `mode` (from 0) along a chain of n springs k [N/m] with one end fixed,
/// nodes of mass m [kg] and half of it at the free end [rad/s]: the even modes of a chain of twice
/// the length, mirrored at its middle.
inline double spring_chain_omega(int n, double stiffness, double mass, int mode) {
  return 2 * std::sqrt(stiffness / mass) * std::sin((2 * mode + 1) * kPi / (4 * n));
}

/// Elongation of the same chain hanging under its weight [m]: spring i of n carries n - i + 1/2
/// nodes.
inline double spring_chain_elongation(int n, double stiffness, double mass, double gravity) {
  return mass * gravity / stiffness * n * n / 2;
}

}  // namespace pleat
