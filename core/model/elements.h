#pragma once

#include <algorithm>

#include "core/base/check.h"
#include "core/fabric/element_hessian.h"
#include "core/model/cloth_model.h"

namespace pleat {

template <class Element>
std::size_t bytes_of(const std::vector<Element>& elements) {
  return elements.size() * sizeof(Element);
}

/// Length and direction of a spring; at zero length the direction is zero, so that it pulls
/// nowhere.
struct SpringAxis {
  double length;   ///< [m]
  Vec3 direction;  ///< direction from b to a, unit or zero
};

inline SpringAxis spring_axis(const Spring& spring, const PositionsView& positions) {
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

/// The matrix that a system of equations asks elements for: stiffness * K + damping * C, with
/// K = -d(elastic force)/dx [N/m] and C = -d(damping force)/dv [N s/m].
struct MatrixShares {
  double stiffness = 1;
  double damping = 0;
  ElementHessian hessian = ElementHessian::exact;
};

/// Half of what the rows of K and C around each vertex add up to in size, at most: k and c of a
/// spring count once at each end.
struct RowSums {
  Eigen::VectorXd stiffness;  ///< [N/m]
  Eigen::VectorXd damping;    ///< [N s/m]
};

/// A kind of element is a struct that reads its elements from a model. Every walk over elements
/// goes through `for_each_element_kind` and asks each kind for
///
///     empty()                             whether the model has none
///     check()                             ContractError where an element breaks its promises
///     for_each_part(note)                 note(is_built, name, bytes) for what the build report
///                                         tells; 0 where others have its bytes
///     for_each_pair(join)                 join(a, b) for all pairs of vertices of an element
///     add_energy(x, energy)               [J], element by element
///     add_forces(x, forces)               -dE/dx [N]
///     add_damping_forces(x, v, forces)    [N]; none unless the kind says so
///     add_internal_forces(x, v, forces)   both, in one pass, where `kHasInternalForces`
///     add_to_matrix(x, shares, blocks)    3 x 3 blocks, pairs in the order of for_each_pair
///     add_row_sums(sums)                  bounds for any positions that cloth takes
///
/// and whether it is `kInPlainLattice`. The calls are resolved at compile time. `blocks` is what
/// SystemMatrix::add_elasticity hands over.
struct ElementKind {
  static constexpr bool kInPlainLattice = false;
  static constexpr bool kHasInternalForces = false;

  explicit ElementKind(const ClothModel& model) : model_(model) {}

  void check() const {}
  void add_damping_forces(const PositionsView&, const PositionsView&, const PositionsRef&) const {}

 protected:
  /// join(a, b) for all pairs of an element's vertices.
  template <class Vertices, class Join>
  static void join_all(const Vertices& vertices, Join&& join) {
    for (std::size_t i = 0; i < vertices.size(); ++i)
      for (std::size_t j = i + 1; j < vertices.size(); ++j) join(vertices[i], vertices[j]);
  }

  const ClothModel& model_;
};

/// Springs and the dampers beside them.
struct SpringElements : ElementKind {
  using ElementKind::ElementKind;
  static constexpr bool kInPlainLattice = true;
  static constexpr bool kHasInternalForces = true;

  bool empty() const { return model_.springs.empty(); }
  void check() const;
  template <class Note>
  void for_each_part(Note&& note) const {
    note(!empty(), "springs", bytes_of(model_.springs));
    note(std::any_of(model_.springs.begin(), model_.springs.end(),
                     [](const Spring& spring) { return spring.damping > 0; }),
         "dampers", 0);
    if (std::any_of(model_.springs.begin(), model_.springs.end(),
                    [](const Spring& spring) { return spring.kind == SpringKind::bend; }))
      note(true, "bending", 0);
  }
  template <class Join>
  void for_each_pair(Join&& join) const {
    for (const Spring& spring : model_.springs) join(spring.a, spring.b);
  }
  void add_energy(const PositionsView& positions, double& energy) const;
  void add_forces(const PositionsView& positions, PositionsRef forces) const;
  void add_damping_forces(const PositionsView& positions, const PositionsView& velocities,
                          PositionsRef forces) const;
  void add_internal_forces(const PositionsView& positions, const PositionsView& velocities,
                           PositionsRef forces) const;
  template <class Blocks>
  void add_to_matrix(const PositionsView& positions, const MatrixShares& shares,
                     Blocks& blocks) const {
    for (const Spring& spring : model_.springs) {
      const SpringAxis axis = spring_axis(spring, positions);
      blocks.add_difference(
          spring.a, spring.b,
          shares.stiffness * spring_stiffness(spring, axis, shares.hessian) +
              shares.damping * spring_damping(spring, axis, model_.damping_direction));
    }
  }
  void add_row_sums(RowSums& sums) const;
};

/// Springs that pull beyond their rest length and never push.
struct TautSpringElements : ElementKind {
  using ElementKind::ElementKind;

  bool empty() const { return model_.taut_springs.empty(); }
  void check() const;
  template <class Note>
  void for_each_part(Note&& note) const {
    note(!empty(), "stretch stiffening", bytes_of(model_.taut_springs));
  }
  template <class Join>
  void for_each_pair(Join&& join) const {
    for (const Spring& spring : model_.taut_springs) join(spring.a, spring.b);
  }
  void add_energy(const PositionsView& positions, double& energy) const;
  void add_forces(const PositionsView& positions, PositionsRef forces) const;
  template <class Blocks>
  void add_to_matrix(const PositionsView& positions, const MatrixShares& shares,
                     Blocks& blocks) const {
    for (const Spring& spring : model_.taut_springs) {
      const SpringAxis axis = spring_axis(spring, positions);
      if (axis.length > spring.rest_length)
        blocks.add_difference(spring.a, spring.b,
                              shares.stiffness * spring_stiffness(spring, axis, shares.hessian));
      else
        blocks.skip_pair();
    }
  }
  void add_row_sums(RowSums& sums) const;
};

/// Quadratic bending along mesh lines.
struct BendElements : ElementKind {
  using ElementKind::ElementKind;
  static constexpr bool kInPlainLattice = true;

  bool empty() const { return model_.bends.empty(); }
  void check() const;
  template <class Note>
  void for_each_part(Note&& note) const {
    note(!empty(), "bending", bytes_of(model_.bends));
  }
  template <class Join>
  void for_each_pair(Join&& join) const {
    for (const BendElement& bend : model_.bends) join_all(bend.vertices, join);
  }
  void add_energy(const PositionsView& positions, double& energy) const;
  void add_forces(const PositionsView& positions, PositionsRef forces) const;
  template <class Blocks>
  void add_to_matrix(const PositionsView&, const MatrixShares& shares, Blocks& blocks) const {
    for (const BendElement& bend : model_.bends) {
      const auto& w = bend.weights;
      const double s = shares.stiffness * bend.stiffness;
      for (int i = 0; i < 3; ++i) {
        blocks.add_to_diagonal(bend.vertices[i], s * w[i] * w[i]);
        for (int j = i + 1; j < 3; ++j) blocks.add_to_pair(s * w[i] * w[j]);
      }
    }
  }
  void add_row_sums(RowSums& sums) const;
};

/// Bending along mesh lines by the chord.
struct ChordElements : ElementKind {
  using ElementKind::ElementKind;

  bool empty() const { return model_.chord_bends.empty(); }
  template <class Note>
  void for_each_part(Note&& note) const {
    note(!empty(), "bending", bytes_of(model_.chord_bends));
  }
  template <class Join>
  void for_each_pair(Join&& join) const {
    for (const ChordBend& bend : model_.chord_bends) join(bend.a, bend.b);
  }
  void add_energy(const PositionsView& positions, double& energy) const {
    energy += chord_energy(model_.chord_bends, positions);
  }
  void add_forces(const PositionsView& positions, PositionsRef forces) const {
    add_chord_forces(model_.chord_bends, positions, forces);
  }
  template <class Blocks>
  void add_to_matrix(const PositionsView& positions, const MatrixShares& shares,
                     Blocks& blocks) const {
    for (const ChordBend& bend : model_.chord_bends)
      blocks.add_difference(bend.a, bend.b,
                            shares.stiffness * chord_stiffness(bend, positions, shares.hessian));
  }
  void add_row_sums(RowSums& sums) const;
};

/// Friction inside bent cloth.
struct BendFrictionElements : ElementKind {
  using ElementKind::ElementKind;

  bool empty() const { return !model_.bend_friction; }
  template <class Note>
  void for_each_part(Note&& note) const {
    note(!empty(), "inner friction", empty() ? 0 : model_.bend_friction->bytes());
  }
  template <class Join>
  void for_each_pair(Join&& join) const {
    if (empty()) return;
    for (const BendFriction::Element& element : model_.bend_friction->elements())
      join_all(element.bend.vertices, join);
  }
  void add_energy(const PositionsView& positions, double& energy) const {
    if (!empty()) energy += model_.bend_friction->energy(positions);
  }
  void add_forces(const PositionsView& positions, PositionsRef forces) const {
    if (!empty()) model_.bend_friction->add_forces(positions, forces);
  }
  template <class Blocks>
  void add_to_matrix(const PositionsView& positions, const MatrixShares& shares,
                     Blocks& blocks) const {
    if (empty()) return;
    for (const BendFriction::Element& element : model_.bend_friction->elements()) {
      const double s = shares.stiffness * model_.bend_friction->tangent(element, positions);
      Vec9 slope;  // derivative of the curvature
      for (int k = 0; k < 3; ++k)
        slope.segment<3>(3 * k) = element.bend.weights[k] * element.normal;
      const Mat9 block = s * slope * slope.transpose();
      blocks.add_element(element.bend.vertices, block);
    }
  }
  void add_row_sums(RowSums& sums) const;
};

/// Triangles of the membrane and their viscosity.
struct MembraneElements : ElementKind {
  using ElementKind::ElementKind;

  bool empty() const { return model_.membrane.elements.empty(); }
  void check() const {
    PLEAT_CHECK(model_.membrane_relaxation >= 0, "a relaxation time is not negative");
  }
  template <class Note>
  void for_each_part(Note&& note) const {
    note(!empty(), "membrane", bytes_of(model_.membrane.elements));
    note(!empty() && model_.membrane_relaxation > 0, "dampers", 0);
    note(!empty() && model_.membrane.law.stiffening_strain > 0, "stretch stiffening", 0);
  }
  template <class Join>
  void for_each_pair(Join&& join) const {
    for (const MembraneElement& element : model_.membrane.elements)
      join_all(element.vertices, join);
  }
  void add_energy(const PositionsView& positions, double& energy) const {
    energy += membrane_energy(model_.membrane, positions);
  }
  void add_forces(const PositionsView& positions, PositionsRef forces) const {
    add_membrane_forces(model_.membrane, positions, forces);
  }
  void add_damping_forces(const PositionsView& positions, const PositionsView& velocities,
                          PositionsRef forces) const;
  template <class Blocks>
  void add_to_matrix(const PositionsView& positions, const MatrixShares& shares,
                     Blocks& blocks) const {
    const MembraneLaw& law = model_.membrane.law;
    const double viscosity_share = shares.damping * model_.membrane_relaxation;
    for (const MembraneElement& element : model_.membrane.elements) {
      Mat9 block = shares.stiffness * membrane_stiffness(law, element, positions, shares.hessian);
      if (viscosity_share > 0)
        block += viscosity_share * membrane_viscosity(law, element, positions);
      blocks.add_element(element.vertices, block);
    }
  }
  void add_row_sums(RowSums& sums) const;
};

/// Bending about inner edges.
struct HingeElements : ElementKind {
  using ElementKind::ElementKind;

  bool empty() const { return model_.hinges.empty(); }
  template <class Note>
  void for_each_part(Note&& note) const {
    note(!empty(), "bending", bytes_of(model_.hinges));
  }
  template <class Join>
  void for_each_pair(Join&& join) const {
    for (const Hinge& hinge : model_.hinges) join_all(hinge.vertices, join);
  }
  void add_energy(const PositionsView& positions, double& energy) const {
    energy += hinge_energy(model_.hinges, positions);
  }
  void add_forces(const PositionsView& positions, PositionsRef forces) const {
    add_hinge_forces(model_.hinges, positions, forces);
  }
  template <class Blocks>
  void add_to_matrix(const PositionsView& positions, const MatrixShares& shares,
                     Blocks& blocks) const {
    for (const Hinge& hinge : model_.hinges)
      blocks.add_element(hinge.vertices,
                         shares.stiffness * hinge_stiffness(hinge, positions, shares.hessian));
  }
  /// Infinite: a hinge stiffens without bound as a flap loses its height.
  void add_row_sums(RowSums& sums) const;
};

/// Bending fitted to a triangle mesh, whose Hessian Q is constant. An element is an entry of Q.
struct FittedBendingElements : ElementKind {
  using ElementKind::ElementKind;

  bool empty() const { return !model_.has_fitted_bending(); }
  void check() const;
  template <class Note>
  void for_each_part(Note&& note) const {
    note(!empty(), "bending",
         static_cast<std::size_t>(model_.fitted_bending.nonZeros()) *
             (sizeof(double) + sizeof(int)));
  }
  template <class Join>
  void for_each_pair(Join&& join) const {
    const SparseMatrix& bending = model_.fitted_bending;
    for (int column = 0; column < bending.outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(bending, column); entry; ++entry)
        if (entry.row() > column) join(VertexId(entry.row()), VertexId(column));
  }
  void add_energy(const PositionsView& positions, double& energy) const;
  void add_forces(const PositionsView& positions, PositionsRef forces) const;
  template <class Blocks>
  void add_to_matrix(const PositionsView&, const MatrixShares& shares, Blocks& blocks) const {
    const SparseMatrix& bending = model_.fitted_bending;
    for (int column = 0; column < bending.outerSize(); ++column) {
      for (SparseMatrix::InnerIterator entry(bending, column); entry; ++entry) {
        const double q = shares.stiffness * entry.value();
        if (entry.row() > column)
          blocks.add_to_pair(q);
        else
          blocks.add_to_diagonal(VertexId(column), q);
      }
    }
  }
  void add_row_sums(RowSums& sums) const;
};

/// Calls visit(kind) for every kind of element, also for those that the model has none of. Sums are
/// taken in this order.
template <class Visit>
void for_each_element_kind(const ClothModel& model, Visit&& visit) {
  visit(SpringElements(model));
  visit(TautSpringElements(model));
  visit(BendElements(model));
  visit(ChordElements(model));
  visit(BendFrictionElements(model));
  visit(MembraneElements(model));
  visit(HingeElements(model));
  visit(FittedBendingElements(model));
}

}  // namespace pleat
