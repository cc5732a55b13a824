#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/mesh/quad_mesh.h"
#include "core/model/wind.h"

namespace pleat {

struct AirOptions {
  double density = 1.2;              ///< rho [kg/m^3], positive
  double normal_coefficient = 1;     ///< C_n, not negative
  double tangent_coefficient = 0.1;  ///< C_t, not negative
  WindOptions wind;
};

/// Drag of air, per triangle: f = 1/2 rho A |u| (C_n u_n + C_t u_t), where u is the wind minus the
/// triangle's velocity and u_n, u_t its normal and tangential parts; a third of f on each corner.
class AirDrag {
 public:
  /// share  of each triangle's area that counts: 1/2 for triangles that cover the cloth twice.
  AirDrag(std::vector<Triangle> triangles, const AirOptions& options, int n_vertices,
          double share = 1);

  /// Lets the wind be what it is at a time [s]; of no effect in still air.
  void set_time(double time) {
    if (wind_) wind_velocity_ = wind_->velocity(time);
  }
  bool has_wind() const { return wind_.has_value(); }

  /// Takes the law above at these places and velocities, for `forces` and `resistance`.
  void evaluate(const PositionsView& positions, const PositionsView& velocities);
  /// The force on each vertex [N].
  const Positions& forces() const { return drag_; }
  /// D >= -df/dv lumped to the vertex [N s/m].
  Mat3 resistance(VertexId vertex) const;

  /// Evaluates, and adds the law to `forces` [N]; what acts on vertices that hang, to their
  /// parents', also in `resistance`.
  void add_forces(const PositionsView& positions, const PositionsView& velocities,
                  std::span<const HangingVertex> hanging, PositionsRef forces);

  /// Evaluates, and sets `forces` [N] to F in place of the law's f, for steps of h [s] that do not
  /// solve for drag: F = f - D dv with the change dv of velocity that F and other forces G make. It
  /// is first-order consistent, stable for any h, and equal to f where motion is steady.
  ///
  /// others  G, one column a vertex [N]: what is known of them, as those of the last step
  void set_damped_forces(const PositionsView& positions, const PositionsView& velocities,
                         const Eigen::VectorXd& masses, std::span<const HangingVertex> hanging,
                         double h, const PositionsView& others, PositionsRef forces);

  /// Sets a factor on the force, 1 at first: lets drag keep up while motion is carried over to
  /// cloth of another weight.
  void set_strength(double factor) { strength_ = factor; }
  double strength() const { return strength_; }

  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Memory of its triangles, forces and resistances.
  std::size_t bytes() const;

 private:
  std::vector<Triangle> triangles_;
  AirOptions options_;
  double share_;
  double strength_ = 1;
  std::optional<Wind> wind_;                             // none in still air
  Vec3 wind_velocity_{0, 0, 0};                          // [m/s]
  Positions drag_;                                       // force of the air alone [N]
  Eigen::Matrix<double, 6, Eigen::Dynamic> resistance_;  // lumped D, xx yy zz xy xz yz [N s/m]
};

}  // namespace pleat
