#pragma once

#include <span>
#include <vector>

#include "core/mesh/quad_mesh.h"

namespace pleat {

struct AirOptions {
  double density = 1.2;              ///< rho [kg/m^3], positive
  double normal_coefficient = 1;     ///< C_n, not negative
  double tangent_coefficient = 0.1;  ///< C_t, not negative
};

/// Drag of still air, per triangle: f = 1/2 rho A |u| (C_n u_n + C_t u_t), where u is minus the
/// triangle's velocity and u_n, u_t its normal and tangential parts; a third of f on each corner.
class AirDrag {
 public:
  /// share  of each triangle's area that counts: 1/2 for triangles that cover the cloth twice.
  AirDrag(std::vector<Triangle> triangles, const AirOptions& options, int n_vertices,
          double share = 1);

  /// Takes the law above at these places and velocities, for `forces` and `resistance`.
  void evaluate(const Eigen::Ref<const Positions>& positions,
                const Eigen::Ref<const Positions>& velocities);
  /// The force on each vertex [N].
  const Positions& forces() const { return drag_; }
  /// D >= -df/dv lumped to the vertex [N s/m].
  Mat3 resistance(VertexId vertex) const;

  /// Evaluates, and adds drag to `forces` [N]; what acts on vertices that hang, to their parents'.
  ///
  /// h  0 gives the law above. Positive gives the force that a linearly implicit step of h [s]
  /// applies,
  ///    (I + h D/m)^-1 f with the lumped D: first-order consistent and never
  ///    overshooting, so that light cloth may take large steps.
  void add_forces(const Eigen::Ref<const Positions>& positions,
                  const Eigen::Ref<const Positions>& velocities, const Eigen::VectorXd& masses,
                  std::span<const HangingVertex> hanging, double h, Eigen::Ref<Positions> forces);

  /// Factor on the force, 1 to begin with: lets drag keep up while motion is carried over to cloth
  /// of another weight.
  void set_strength(double factor) { strength_ = factor; }
  double strength() const { return strength_; }

  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  std::vector<Triangle> triangles_;
  AirOptions options_;
  double share_;
  double strength_ = 1;
  Positions drag_;                                       // force of the air alone [N]
  Eigen::Matrix<double, 6, Eigen::Dynamic> resistance_;  // lumped D, xx yy zz xy xz yz [N s/m]
};

}  // namespace pleat
