#pragma once

#include <vector>

#include <Eigen/Core>

namespace pleat {

/// A planar chain of rigid links that hangs from a fixed point: the limit of an inextensible limp
/// cloth strip.
///
/// The angles of the links from straight down are its coordinates, so that lengths hold exactly;
/// they are integrated by the classical Runge-Kutta method. It shares no code with the steppers.
class RigidChain {
 public:
  /// lengths  of the links, from the fixed end [m], positive
  /// masses   of the node at the far end of each link [kg], positive, same count
  /// gravity  downward [m/s^2], not negative
  ///
  /// It begins at rest, straight down. Throws ContractError when a promise is broken.
  RigidChain(std::vector<double> lengths, std::vector<double> masses, double gravity);

  /// angles  from straight down [rad];  rates  [rad/s]; one of each per link.
  void place(const Eigen::VectorXd& angles, const Eigen::VectorXd& rates);

  /// Integrates over `duration` [s] in `n_steps` equal steps.
  void advance(double duration, int n_steps);

  const Eigen::VectorXd& angles() const { return angles_; }
  const Eigen::VectorXd& rates() const { return rates_; }

  /// Nodes from the fixed point on, one column each: sideways and up from the fixed point [m].
  Eigen::Matrix2Xd positions() const;

  double energy() const;  ///< kinetic and gravitational [J], zero height at the fixed point

 private:
  int n_links() const { return static_cast<int>(lengths_.size()); }
  const Eigen::VectorXd& angular_accelerations(const Eigen::VectorXd& angles,
                                               const Eigen::VectorXd& rates);

  std::vector<double> lengths_;
  std::vector<double> masses_;
  double gravity_;
  Eigen::VectorXd angles_;
  Eigen::VectorXd rates_;
  Eigen::VectorXd sines_;
  Eigen::VectorXd cosines_;
  Eigen::VectorXd pulls_;     // tension of each link [N]
  Eigen::VectorXd diagonal_;  // diagonal of the tridiagonal system, then of its factor
  Eigen::VectorXd accelerations_;
};

}  // namespace pleat
