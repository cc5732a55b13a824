#pragma once

#include "core/fabric/element_hessian.h"
#include "core/model/cloth_model.h"
#include "core/model/state.h"

namespace pleat {

/// Length and direction of a spring; at zero length the direction is zero, so that it pulls
/// nowhere.
struct SpringAxis {
  double length;   ///< [m]
  Vec3 direction;  ///< from b to a, unit or zero
};

inline SpringAxis spring_axis(const Spring& spring, const Eigen::Ref<const Positions>& positions) {
  const Vec3 d = positions.col(spring.a) - positions.col(spring.b);
  const double length = d.norm();
  return {length, length > 0 ? Vec3(d / length) : Vec3(Vec3::Zero())};
}

/// -d(force on a)/d(x_a) of the spring alone: k [(1 - L/l)(I - u u^T) + u u^T], in [N/m].
inline Mat3 spring_stiffness(const Spring& spring, const SpringAxis& axis, ElementHessian hessian) {
  const double ratio = axis.length > 0 ? 1 - spring.rest_length / axis.length : 0;
  const double across = hessian == ElementHessian::projected ? std::max(0.0, ratio) : ratio;
  return spring.stiffness *
         (across * Mat3::Identity() + (1 - across) * axis.direction * axis.direction.transpose());
}

/// -d(force on a)/d(v_a) of the damper, in [N s/m].
inline Mat3 spring_damping(const Spring& spring, const SpringAxis& axis,
                           DampingDirection direction) {
  if (direction == DampingDirection::isotropic) return spring.damping * Mat3::Identity();
  return spring.damping * axis.direction * axis.direction.transpose();
}

/// Energy stored in the cloth, stretched and bent [J].
double elastic_energy(const ClothModel& model, const Eigen::Ref<const Positions>& positions);

/// Elastic, kinetic and gravitational energy [J]; height zero is the origin.
double total_energy(const ClothModel& model, const State& state);

/// Adds the forces of all elements [N].
void add_elastic_forces(const ClothModel& model, const Eigen::Ref<const Positions>& positions,
                        Eigen::Ref<Positions> forces);

/// Adds the forces of dampers and of the membrane's viscosity [N].
void add_damping_forces(const ClothModel& model, const Eigen::Ref<const Positions>& positions,
                        const Eigen::Ref<const Positions>& velocities,
                        Eigen::Ref<Positions> forces);

/// Adds weight [N].
void add_gravity(const ClothModel& model, Eigen::Ref<Positions> forces);

}  // namespace pleat
