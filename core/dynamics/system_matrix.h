#pragma once

#include <vector>

#include "core/dynamics/elasticity.h"
#include "core/linalg/vertex_matrix.h"

namespace pleat {

/// What the implicit steppers solve with: a block for every pair of vertices that an element of a
/// model joins. Values are added element by element.
class SystemMatrix : public VertexMatrix {
 public:
  /// model  outlives the matrix and keeps its elements.
  explicit SystemMatrix(const ClothModel& model);

  /// Adds factor * m to the diagonal of each vertex.
  void add_masses(double factor);
  /// Adds stiffness_factor * K + damping_factor * C at these positions: K = -d(elastic force)/dx
  /// [N/m], C = -d(damping force)/dv [N s/m].
  void add_elasticity(const Eigen::Ref<const Positions>& positions, double stiffness_factor,
                      double damping_factor, ElementHessian hessian);

 private:
  SystemMatrix(const ClothModel& model, const std::vector<Pair>& pairs);
  void add_spring(const Spring& spring, const Slot& slot, const Mat3& block);

  const ClothModel& model_;
  std::vector<Slot> slots_;  // of the pairs that elements join, in the order of assembly
};

/// K = -d(elastic force)/dx at these positions, lower triangle, 3n x 3n [N/m].
SparseMatrix stiffness_matrix(const ClothModel& model, const Eigen::Ref<const Positions>& positions,
                              ElementHessian hessian);

/// C = -d(damping force)/dv, lower triangle, 3n x 3n [N s/m].
SparseMatrix damping_matrix(const ClothModel& model, const Eigen::Ref<const Positions>& positions);

/// M, lumped, 3n x 3n [kg].
SparseMatrix mass_matrix(const ClothModel& model);

}  // namespace pleat
