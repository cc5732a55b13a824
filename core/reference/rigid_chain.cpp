#include "core/reference/rigid_chain.h"

#include <cmath>

#include "core/base/check.h"

namespace pleat {

RigidChain::RigidChain(std::vector<double> lengths, std::vector<double> masses, double gravity)
    : lengths_(std::move(lengths)), masses_(std::move(masses)), gravity_(gravity) {
  PLEAT_CHECK(!lengths_.empty() && lengths_.size() == masses_.size(), "one mass for each link");
  PLEAT_CHECK(gravity >= 0, "gravity points down");
  for (const double length : lengths_) PLEAT_CHECK(length > 0, "links have positive length");
  for (const double mass : masses_) PLEAT_CHECK(mass > 0, "nodes have positive mass");
  for (Eigen::VectorXd* values :
       {&angles_, &rates_, &sines_, &cosines_, &pulls_, &diagonal_, &accelerations_})
    values->setZero(n_links());
}

void RigidChain::place(const Eigen::VectorXd& angles, const Eigen::VectorXd& rates) {
  PLEAT_CHECK(angles.size() == n_links() && rates.size() == n_links(), "one angle for each link");
  angles_ = angles;
  rates_ = rates;
}

// Link i runs from node i-1 to node i along u_i = (sin, -cos) and turns along n_i = (cos, sin).
// With pulls T,
//   m_i a_i = m_i g - T_i u_i + T_{i+1} u_{i+1},   a_i - a_{i-1} = l_i (alpha_i n_i - omega_i^2
//   u_i),   a_0 = 0.
// Along u_i, with c_i = u_{i-1}.u_i, this is tridiagonal in T, symmetric and positive definite:
//   -c_i/m_{i-1} T_{i-1} + (1/m_{i-1} + 1/m_i) T_i - c_{i+1}/m_i T_{i+1} = l_i omega_i^2   (first
//   link: + g.u_1, no m_0).
// Along n_i it gives alpha_i.
const Eigen::VectorXd& RigidChain::angular_accelerations(const Eigen::VectorXd& angles,
                                                         const Eigen::VectorXd& rates) {
  const int n = n_links();
  for (int i = 0; i < n; ++i) {
    sines_[i] = std::sin(angles[i]);
    cosines_[i] = std::cos(angles[i]);
  }
  const auto off_diagonal = [&](int i) {  // entry for links i-1 and i
    return -(sines_[i - 1] * sines_[i] + cosines_[i - 1] * cosines_[i]) / masses_[i - 1];
  };
  for (int i = 0; i < n; ++i) {
    diagonal_[i] = 1 / masses_[i] + (i > 0 ? 1 / masses_[i - 1] : 0);
    pulls_[i] = lengths_[i] * rates[i] * rates[i] + (i == 0 ? gravity_ * cosines_[0] : 0);
    if (i == 0) continue;
    const double factor = off_diagonal(i) / diagonal_[i - 1];
    diagonal_[i] -= factor * off_diagonal(i);
    pulls_[i] -= factor * pulls_[i - 1];
  }
  for (int i = n - 1; i >= 0; --i) {
    if (i + 1 < n) pulls_[i] -= off_diagonal(i + 1) * pulls_[i + 1];
    pulls_[i] /= diagonal_[i];
  }
  // n_i . (a_i - a_{i-1}); weight acts on the difference only at the first link, whose other end
  // does not fall.
  const auto cross = [&](int j, int i) {  // u_j . n_i
    return sines_[j] * cosines_[i] - cosines_[j] * sines_[i];
  };
  for (int i = 0; i < n; ++i) {
    double along =
        i == 0 ? -gravity_ * sines_[0] : pulls_[i - 1] * cross(i - 1, i) / masses_[i - 1];
    if (i + 1 < n) along += pulls_[i + 1] * cross(i + 1, i) / masses_[i];
    accelerations_[i] = along / lengths_[i];
  }
  return accelerations_;
}

void RigidChain::advance(double duration, int n_steps) {
  PLEAT_CHECK(duration > 0 && n_steps >= 1, "at least one step forward in time");
  const double h = duration / n_steps;
  Eigen::VectorXd rate_1, rate_2, rate_3, rate_4, turn_1, turn_2, turn_3, turn_4;
  for (int step = 0; step < n_steps; ++step) {
    rate_1 = rates_;
    turn_1 = angular_accelerations(angles_, rate_1);
    rate_2 = rates_ + h / 2 * turn_1;
    turn_2 = angular_accelerations(angles_ + h / 2 * rate_1, rate_2);
    rate_3 = rates_ + h / 2 * turn_2;
    turn_3 = angular_accelerations(angles_ + h / 2 * rate_2, rate_3);
    rate_4 = rates_ + h * turn_3;
    turn_4 = angular_accelerations(angles_ + h * rate_3, rate_4);
    angles_ += h / 6 * (rate_1 + 2 * rate_2 + 2 * rate_3 + rate_4);
    rates_ += h / 6 * (turn_1 + 2 * turn_2 + 2 * turn_3 + turn_4);
  }
}

Eigen::Matrix2Xd RigidChain::positions() const {
  Eigen::Matrix2Xd nodes(2, n_links() + 1);
  nodes.col(0).setZero();
  for (int i = 0; i < n_links(); ++i)
    nodes.col(i + 1) =
        nodes.col(i) + lengths_[i] * Eigen::Vector2d(std::sin(angles_[i]), -std::cos(angles_[i]));
  return nodes;
}

double RigidChain::energy() const {
  double energy = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  for (int i = 0; i < n_links(); ++i) {
    const double s = std::sin(angles_[i]);
    const double c = std::cos(angles_[i]);
    place += lengths_[i] * Eigen::Vector2d(s, -c);
    velocity += lengths_[i] * rates_[i] * Eigen::Vector2d(c, s);
    energy += masses_[i] * (0.5 * velocity.squaredNorm() + gravity_ * place.y());
  }
  return energy;
}

}  // namespace pleat
