#include "core/dynamics/elasticity.h"

namespace pleat {
namespace {

/// The curvature vector of a bending element [1/m].
Vec3 curvature(const BendElement& bend, const Eigen::Ref<const Positions>& positions) {
  return bend.weights[0] * positions.col(bend.vertices[0]) +
         bend.weights[1] * positions.col(bend.vertices[1]) +
         bend.weights[2] * positions.col(bend.vertices[2]);
}

}  // namespace

double elastic_energy(const ClothModel& model, const Eigen::Ref<const Positions>& positions) {
  double energy = 0;
  for (const Spring& spring : model.springs) {
    const double stretch =
        (positions.col(spring.a) - positions.col(spring.b)).norm() - spring.rest_length;
    energy += 0.5 * spring.stiffness * stretch * stretch;
  }
  for (const BendElement& bend : model.bends)
    energy += 0.5 * bend.stiffness * curvature(bend, positions).squaredNorm();
  return energy;
}

double total_energy(const ClothModel& model, const State& state) {
  double energy = elastic_energy(model, state.positions);
  for (int i = 0; i < model.n_vertices(); ++i)
    energy += model.masses[i] * (0.5 * state.velocities.col(i).squaredNorm() -
                                 model.gravity.dot(state.positions.col(i)));
  return energy;
}

void add_elastic_forces(const ClothModel& model, const Eigen::Ref<const Positions>& positions,
                        Eigen::Ref<Positions> forces) {
  for (const Spring& spring : model.springs) {
    const SpringAxis axis = spring_axis(spring, positions);
    const Vec3 pull = spring.stiffness * (axis.length - spring.rest_length) * axis.direction;
    forces.col(spring.a) -= pull;
    forces.col(spring.b) += pull;
  }
  for (const BendElement& bend : model.bends) {
    const Vec3 moment = bend.stiffness * curvature(bend, positions);
    for (int k = 0; k < 3; ++k) forces.col(bend.vertices[k]) -= bend.weights[k] * moment;
  }
}

void add_damping_forces(const ClothModel& model, const Eigen::Ref<const Positions>& positions,
                        const Eigen::Ref<const Positions>& velocities,
                        Eigen::Ref<Positions> forces) {
  for (const Spring& spring : model.springs) {
    if (spring.damping == 0) continue;
    const Vec3 relative = velocities.col(spring.a) - velocities.col(spring.b);
    const Vec3 drag =
        spring_damping(spring, spring_axis(spring, positions), model.damping_direction) * relative;
    forces.col(spring.a) -= drag;
    forces.col(spring.b) += drag;
  }
}

void add_gravity(const ClothModel& model, Eigen::Ref<Positions> forces) {
  forces.noalias() += model.gravity * model.masses.transpose();
}

}  // namespace pleat
