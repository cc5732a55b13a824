#include "core/model/elasticity.h"

namespace pleat {
namespace {

/// The curvature vector of a bending element [1/m].
Vec3 curvature(const BendElement& bend, const Eigen::Ref<const Positions>& positions) {
  return bend.weights[0] * positions.col(bend.vertices[0]) +
         bend.weights[1] * positions.col(bend.vertices[1]) +
         bend.weights[2] * positions.col(bend.vertices[2]);
}

/// Calls visit(i, j, Q_ij) for every entry below the diagonal. The rows of a bending matrix sum to
/// zero, so that 1/2 tr(X Q X^T) = -1/2 sum over i > j of Q_ij |x_i - x_j|^2: in differences,
/// nothing is lost far from the origin.
template <class Visit>
void for_each_pair(const SparseMatrix& lower, Visit&& visit) {
  for (int column = 0; column < lower.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry)
      if (entry.row() != entry.col()) visit(entry.row(), entry.col(), entry.value());
}

double spring_energy(const Spring& spring, const Eigen::Ref<const Positions>& positions) {
  const double stretch =
      (positions.col(spring.a) - positions.col(spring.b)).norm() - spring.rest_length;
  return 0.5 * spring.stiffness * stretch * stretch;
}

bool is_taut(const Spring& spring, const Eigen::Ref<const Positions>& positions) {
  return (positions.col(spring.a) - positions.col(spring.b)).squaredNorm() >
         spring.rest_length * spring.rest_length;
}

void add_spring_force(const Spring& spring, const Eigen::Ref<const Positions>& positions,
                      Eigen::Ref<Positions> forces) {
  const SpringAxis axis = spring_axis(spring, positions);
  const Vec3 pull = spring.stiffness * (axis.length - spring.rest_length) * axis.direction;
  forces.col(spring.a) -= pull;
  forces.col(spring.b) += pull;
}

void add_viscous_forces(const ClothModel& model, const Eigen::Ref<const Positions>& positions,
                        const Eigen::Ref<const Positions>& velocities,
                        Eigen::Ref<Positions> forces) {
  const double tau = model.membrane_relaxation;
  for (const MembraneElement& element : model.membrane.elements) {
    Eigen::Matrix<double, 9, 1> v;
    for (int k = 0; k < 3; ++k) v.segment<3>(3 * k) = velocities.col(element.vertices[k]);
    const Eigen::Matrix<double, 9, 1> drag =
        tau * (membrane_viscosity(model.membrane.law, element, positions) * v);
    for (int k = 0; k < 3; ++k) forces.col(element.vertices[k]) -= drag.segment<3>(3 * k);
  }
}

}  // namespace

double elastic_energy(const ClothModel& model, const Eigen::Ref<const Positions>& positions) {
  double energy = 0;
  for (const Spring& spring : model.springs) energy += spring_energy(spring, positions);
  for (const Spring& spring : model.taut_springs)
    if (is_taut(spring, positions)) energy += spring_energy(spring, positions);
  for (const BendElement& bend : model.bends)
    energy += 0.5 * bend.stiffness * curvature(bend, positions).squaredNorm();
  energy += chord_energy(model.chord_bends, positions);
  energy += membrane_energy(model.membrane, positions);
  energy += hinge_energy(model.hinges, positions);
  for_each_pair(model.fitted_bending, [&](Eigen::Index i, Eigen::Index j, double q) {
    energy -= 0.5 * q * (positions.col(i) - positions.col(j)).squaredNorm();
  });
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
  for (const Spring& spring : model.springs) add_spring_force(spring, positions, forces);
  for (const Spring& spring : model.taut_springs)
    if (is_taut(spring, positions)) add_spring_force(spring, positions, forces);
  for (const BendElement& bend : model.bends) {
    const Vec3 moment = bend.stiffness * curvature(bend, positions);
    for (int k = 0; k < 3; ++k) forces.col(bend.vertices[k]) -= bend.weights[k] * moment;
  }
  add_chord_forces(model.chord_bends, positions, forces);
  add_membrane_forces(model.membrane, positions, forces);
  add_hinge_forces(model.hinges, positions, forces);
  for_each_pair(model.fitted_bending, [&](Eigen::Index i, Eigen::Index j, double q) {
    const Vec3 push = q * (positions.col(i) - positions.col(j));
    forces.col(i) += push;
    forces.col(j) -= push;
  });
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
  if (model.membrane_relaxation > 0) add_viscous_forces(model, positions, velocities, forces);
}

void add_gravity(const ClothModel& model, Eigen::Ref<Positions> forces) {
  forces.noalias() += model.gravity * model.masses.transpose();
}

}  // namespace pleat
