#include "core/model/elements.h"

#include <cmath>
#include <limits>

#include "core/fabric/taut_springs.h"

namespace pleat {
namespace {

void check_springs(const std::vector<Spring>& springs) {
  for (const Spring& spring : springs)
    PLEAT_CHECK(spring.stiffness >= 0 && spring.rest_length >= 0 && spring.damping >= 0,
                "stiffness, rest length and damping are not negative");
}

double spring_energy(const Spring& spring, const PositionsView& positions) {
  const double stretch =
      (positions.col(spring.a) - positions.col(spring.b)).norm() - spring.rest_length;
  return 0.5 * spring.stiffness * stretch * stretch;
}

bool is_taut(const Spring& spring, const PositionsView& positions) {
  return (positions.col(spring.a) - positions.col(spring.b)).squaredNorm() >
         spring.rest_length * spring.rest_length;
}

void add_spring_force(const Spring& spring, const PositionsView& positions, PositionsRef forces) {
  const SpringAxis axis = spring_axis(spring, positions);
  const Vec3 pull = spring.stiffness * (axis.length - spring.rest_length) * axis.direction;
  forces.col(spring.a) -= pull;
  forces.col(spring.b) += pull;
}

/// The relative velocity of the ends that the damper resists [m/s].
Vec3 damped_velocity(const Spring& spring, const SpringAxis& axis, const PositionsView& velocities,
                     DampingDirection direction) {
  Vec3 relative = velocities.col(spring.a) - velocities.col(spring.b);
  if (direction == DampingDirection::isotropic) return relative;
  return axis.direction.dot(relative) * axis.direction;
}

void add_spring_sums(const std::vector<Spring>& springs, RowSums& sums) {
  for (const Spring& spring : springs) {
    for (const VertexId v : {spring.a, spring.b}) {
      sums.stiffness[v] += spring.stiffness;
      sums.damping[v] += spring.damping;
    }
  }
}

/// The curvature vector of a bending element [1/m].
Vec3 curvature(const BendElement& bend, const PositionsView& positions) {
  return bend.weights[0] * positions.col(bend.vertices[0]) +
         bend.weights[1] * positions.col(bend.vertices[1]) +
         bend.weights[2] * positions.col(bend.vertices[2]);
}

void add_bend_sums(const BendElement& bend, RowSums& sums) {
  const auto& w = bend.weights;
  const double sum = std::abs(w[0]) + std::abs(w[1]) + std::abs(w[2]);
  for (int k = 0; k < 3; ++k)
    sums.stiffness[bend.vertices[k]] += bend.stiffness * std::abs(w[k]) * sum / 2;
}

/// The material part of an unstrained element's stiffness: its shape lies in the gradients.
Mat9 rest_stiffness(const MembraneLaw& law, MembraneElement element) {
  const Eigen::Matrix2d ends = element.gradients.bottomRows<2>().inverse();  // columns x1, x2
  Positions positions = Positions::Zero(3, 3);
  positions.topRightCorner<2, 2>() = ends;
  element.vertices = {VertexId(0), VertexId(1), VertexId(2)};
  return membrane_viscosity(law, element, positions);
}

/// Calls visit(i, j, Q_ij) for every entry below the diagonal. The rows of a bending matrix sum to
/// zero, so that 1/2 tr(X Q X^T) = -1/2 sum over i > j of Q_ij |x_i - x_j|^2: in differences,
/// nothing is lost far from the origin.
template <class Visit>
void for_each_below_diagonal(const SparseMatrix& lower, Visit&& visit) {
  for (int column = 0; column < lower.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry)
      if (entry.row() != entry.col()) visit(entry.row(), entry.col(), entry.value());
}

}  // namespace

void SpringElements::check() const { check_springs(model_.springs); }

void SpringElements::add_energy(const PositionsView& positions, double& energy) const {
  for (const Spring& spring : model_.springs) energy += spring_energy(spring, positions);
}

void SpringElements::add_forces(const PositionsView& positions, PositionsRef forces) const {
  for (const Spring& spring : model_.springs) add_spring_force(spring, positions, forces);
}

void SpringElements::add_damping_forces(const PositionsView& positions,
                                        const PositionsView& velocities,
                                        PositionsRef forces) const {
  for (const Spring& spring : model_.springs) {
    if (spring.damping == 0) continue;
    const Vec3 drag = spring.damping * damped_velocity(spring, spring_axis(spring, positions),
                                                       velocities, model_.damping_direction);
    forces.col(spring.a) -= drag;
    forces.col(spring.b) += drag;
  }
}

void SpringElements::add_internal_forces(const PositionsView& positions,
                                         const PositionsView& velocities,
                                         PositionsRef forces) const {
  for (const Spring& spring : model_.springs) {
    const SpringAxis axis = spring_axis(spring, positions);
    Vec3 pull = spring.stiffness * (axis.length - spring.rest_length) * axis.direction;
    if (spring.damping > 0)
      pull += spring.damping * damped_velocity(spring, axis, velocities, model_.damping_direction);
    forces.col(spring.a) -= pull;
    forces.col(spring.b) += pull;
  }
}

void SpringElements::add_row_sums(RowSums& sums) const { add_spring_sums(model_.springs, sums); }

void TautSpringElements::check() const { check_springs(model_.taut_springs); }

void TautSpringElements::add_energy(const PositionsView& positions, double& energy) const {
  for (const Spring& spring : model_.taut_springs)
    if (is_taut(spring, positions)) energy += spring_energy(spring, positions);
}

void TautSpringElements::add_forces(const PositionsView& positions, PositionsRef forces) const {
  for (const Spring& spring : model_.taut_springs)
    if (is_taut(spring, positions)) add_spring_force(spring, positions, forces);
}

void TautSpringElements::add_row_sums(RowSums& sums) const {
  add_spring_sums(model_.taut_springs, sums);
}

void BendElements::check() const {
  for (const BendElement& bend : model_.bends)
    PLEAT_CHECK(bend.stiffness >= 0, "bending stiffness is not negative");
}

void BendElements::add_energy(const PositionsView& positions, double& energy) const {
  for (const BendElement& bend : model_.bends)
    energy += 0.5 * bend.stiffness * curvature(bend, positions).squaredNorm();
}

void BendElements::add_forces(const PositionsView& positions, PositionsRef forces) const {
  for (const BendElement& bend : model_.bends) {
    const Vec3 moment = bend.stiffness * curvature(bend, positions);
    for (int k = 0; k < 3; ++k) forces.col(bend.vertices[k]) -= bend.weights[k] * moment;
  }
}

void BendElements::add_row_sums(RowSums& sums) const {
  for (const BendElement& bend : model_.bends) add_bend_sums(bend, sums);
}

void ChordElements::add_row_sums(RowSums& sums) const {
  for (const ChordBend& bend : model_.chord_bends)
    for (const VertexId v : {bend.a, bend.b}) sums.stiffness[v] += bend.stiffness;
}

void BendFrictionElements::add_row_sums(RowSums& sums) const {
  if (empty()) return;
  for (const BendFriction::Element& element : model_.bend_friction->elements())
    add_bend_sums(element.bend, sums);
}

void MembraneElements::add_damping_forces(const PositionsView& positions,
                                          const PositionsView& velocities,
                                          PositionsRef forces) const {
  const double tau = model_.membrane_relaxation;
  if (tau == 0) return;
  for (const MembraneElement& element : model_.membrane.elements) {
    Vec9 v;
    for (int k = 0; k < 3; ++k) v.segment<3>(3 * k) = velocities.col(element.vertices[k]);
    const Vec9 drag = tau * (membrane_viscosity(model_.membrane.law, element, positions) * v);
    for (int k = 0; k < 3; ++k) forces.col(element.vertices[k]) -= drag.segment<3>(3 * k);
  }
}

/// The norm of a block does not change when the element turns, and stretched by a few per cent it
/// hardly does.
void MembraneElements::add_row_sums(RowSums& sums) const {
  const Membrane& membrane = model_.membrane;
  const double stiffening = membrane.law.stiffening_strain > 0 ? kTautFactor : 1;
  for (const MembraneElement& element : membrane.elements) {
    const Mat9 material = rest_stiffness(membrane.law, element);
    for (int i = 0; i < 3; ++i) {
      double row = 0;
      for (int j = 0; j < 3; ++j) row += material.block<3, 3>(3 * i, 3 * j).norm();
      sums.stiffness[element.vertices[i]] += stiffening * row / 2;
      sums.damping[element.vertices[i]] += model_.membrane_relaxation * row / 2;
    }
  }
}

void HingeElements::add_row_sums(RowSums& sums) const {
  for (const Hinge& hinge : model_.hinges)
    for (const VertexId v : hinge.vertices)
      sums.stiffness[v] = std::numeric_limits<double>::infinity();
}

void FittedBendingElements::check() const {
  PLEAT_CHECK(empty() || model_.fitted_bending.rows() == model_.n_vertices(),
              "bending for every vertex");
}

void FittedBendingElements::add_energy(const PositionsView& positions, double& energy) const {
  for_each_below_diagonal(model_.fitted_bending, [&](Eigen::Index i, Eigen::Index j, double q) {
    energy -= 0.5 * q * (positions.col(i) - positions.col(j)).squaredNorm();
  });
}

void FittedBendingElements::add_forces(const PositionsView& positions, PositionsRef forces) const {
  for_each_below_diagonal(model_.fitted_bending, [&](Eigen::Index i, Eigen::Index j, double q) {
    const Vec3 push = q * (positions.col(i) - positions.col(j));
    forces.col(i) += push;
    forces.col(j) -= push;
  });
}

void FittedBendingElements::add_row_sums(RowSums& sums) const {
  const SparseMatrix& bending = model_.fitted_bending;
  for (int column = 0; column < bending.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator entry(bending, column); entry; ++entry) {
      const double half = std::abs(entry.value()) / 2;
      sums.stiffness[column] += half;
      if (entry.row() != column) sums.stiffness[entry.row()] += half;
    }
  }
}

}  // namespace pleat
