#include "core/dynamics/system_matrix.h"

namespace pleat {
namespace {

/// Every pair of vertices that an element joins, in the order of assembly.
std::vector<VertexMatrix::Pair> joined_pairs(const ClothModel& model) {
  std::vector<VertexMatrix::Pair> pairs;
  const auto join_all = [&pairs](const auto& vertices) {
    for (std::size_t i = 0; i < vertices.size(); ++i)
      for (std::size_t j = i + 1; j < vertices.size(); ++j)
        pairs.push_back({vertices[i], vertices[j]});
  };
  for (const Spring& spring : model.springs) pairs.push_back({spring.a, spring.b});
  for (const Spring& spring : model.taut_springs) pairs.push_back({spring.a, spring.b});
  for (const BendElement& bend : model.bends) join_all(bend.vertices);
  for (const ChordBend& bend : model.chord_bends) pairs.push_back({bend.a, bend.b});
  for (const MembraneElement& element : model.membrane.elements) join_all(element.vertices);
  for (const Hinge& hinge : model.hinges) join_all(hinge.vertices);
  const SparseMatrix& bending = model.fitted_bending;
  for (int column = 0; column < bending.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(bending, column); entry; ++entry)
      if (entry.row() > column) pairs.push_back({VertexId(entry.row()), VertexId(column)});
  return pairs;
}

}  // namespace

SystemMatrix::SystemMatrix(const ClothModel& model) : SystemMatrix(model, joined_pairs(model)) {}

SystemMatrix::SystemMatrix(const ClothModel& model, const std::vector<Pair>& pairs)
    : VertexMatrix(model.n_vertices(), pairs), model_(model), slots_(slots(pairs)) {}

void SystemMatrix::add_spring(const Spring& spring, const Slot& slot, const Mat3& block) {
  add_diagonal(spring.a, block);
  add_diagonal(spring.b, block);
  add_block(slot, -block);
}

void SystemMatrix::add_masses(double factor) {
  for (int j = 0; j < model_.n_vertices(); ++j)
    add_to_diagonal(VertexId(j), factor * model_.masses[j]);
}

void SystemMatrix::add_elasticity(const Eigen::Ref<const Positions>& positions,
                                  double stiffness_factor, double damping_factor,
                                  ElementHessian hessian) {
  const Slot* slots = slots_.data();
  for (const Spring& spring : model_.springs) {
    const SpringAxis axis = spring_axis(spring, positions);
    add_spring(spring, *slots++,
               stiffness_factor * spring_stiffness(spring, axis, hessian) +
                   damping_factor * spring_damping(spring, axis, model_.damping_direction));
  }
  for (const Spring& spring : model_.taut_springs) {
    const SpringAxis axis = spring_axis(spring, positions);
    if (axis.length > spring.rest_length)
      add_spring(spring, *slots, stiffness_factor * spring_stiffness(spring, axis, hessian));
    ++slots;
  }
  for (const BendElement& bend : model_.bends) {
    const auto& w = bend.weights;
    const double s = stiffness_factor * bend.stiffness;
    for (int i = 0; i < 3; ++i) {
      add_to_diagonal(bend.vertices[i], s * w[i] * w[i]);
      for (int j = i + 1; j < 3; ++j) add_multiple_of_identity(*slots++, s * w[i] * w[j]);
    }
  }
  for (const ChordBend& bend : model_.chord_bends) {
    const Mat3 block = stiffness_factor * chord_stiffness(bend, positions, hessian);
    add_diagonal(bend.a, block);
    add_diagonal(bend.b, block);
    add_block(*slots++, -block);
  }
  const double viscosity_factor = damping_factor * model_.membrane_relaxation;
  for (const MembraneElement& element : model_.membrane.elements) {
    Eigen::Matrix<double, 9, 9> block =
        stiffness_factor * membrane_stiffness(model_.membrane.law, element, positions, hessian);
    if (viscosity_factor > 0)
      block += viscosity_factor * membrane_viscosity(model_.membrane.law, element, positions);
    add_element(element.vertices, slots, block);
  }
  for (const Hinge& hinge : model_.hinges)
    add_element(hinge.vertices, slots,
                stiffness_factor * hinge_stiffness(hinge, positions, hessian));
  const SparseMatrix& bending = model_.fitted_bending;
  for (int column = 0; column < bending.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator entry(bending, column); entry; ++entry) {
      const double q = stiffness_factor * entry.value();
      if (entry.row() > column)
        add_multiple_of_identity(*slots++, q);
      else
        add_to_diagonal(VertexId(column), q);
    }
  }
}

SparseMatrix stiffness_matrix(const ClothModel& model, const Eigen::Ref<const Positions>& positions,
                              ElementHessian hessian) {
  SystemMatrix matrix(model);
  matrix.add_elasticity(positions, 1, 0, hessian);
  return matrix.lower();
}

SparseMatrix damping_matrix(const ClothModel& model, const Eigen::Ref<const Positions>& positions) {
  SystemMatrix matrix(model);
  matrix.add_elasticity(positions, 0, 1, ElementHessian::projected);
  return matrix.lower();
}

SparseMatrix mass_matrix(const ClothModel& model) {
  const int n = 3 * model.n_vertices();
  SparseMatrix matrix(n, n);
  matrix.reserve(Eigen::VectorXi::Constant(n, 1));
  for (int i = 0; i < n; ++i) matrix.insert(i, i) = model.masses[i / 3];
  matrix.makeCompressed();
  return matrix;
}

}  // namespace pleat
