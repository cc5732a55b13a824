#include "core/deform/deform_energy.h"

#include <cmath>

#include "core/base/check.h"
#include "core/fabric/hinge_bending.h"

namespace pleat {
namespace {

constexpr double kUnitsInDiagonal = 20;  // of the consistent form's length
/// lambda = mu = 1 in lambda/2 tr(E)^2 + mu E:E, as the membrane's law writes it.
constexpr MembraneLaw kIsotropic = {3, 3, 1, 0};

template <std::size_t n>
void join_all(const std::array<VertexId, n>& vertices, std::vector<VertexMatrix::Pair>& pairs) {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) pairs.push_back({vertices[i], vertices[j]});
}

void join_all(const std::vector<VertexId>& vertices, std::vector<VertexMatrix::Pair>& pairs) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t j = i + 1; j < vertices.size(); ++j)
      pairs.push_back({vertices[i], vertices[j]});
}

template <std::size_t n>
std::array<VertexMatrix::Slot, n*(n - 1) / 2> slots_of(const VertexMatrix& matrix,
                                                       const std::array<VertexId, n>& vertices) {
  std::array<VertexMatrix::Slot, n*(n - 1) / 2> slots;
  std::size_t next = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) slots[next++] = matrix.slot(vertices[i], vertices[j]);
  return slots;
}

template <std::size_t n>
void add_element(VertexMatrix& matrix, const std::array<VertexId, n>& vertices,
                 const Eigen::Matrix<double, 3 * n, 3 * n>& block) {
  const auto slots = slots_of(matrix, vertices);
  const VertexMatrix::Slot* next = slots.data();
  matrix.add_element(vertices, next, block);
}

}  // namespace

DeformEnergy::DeformEnergy(const TriangleMesh& mesh, EnergyForm form) : rest_(mesh.rest_positions) {
  PLEAT_CHECK(!mesh.triangles.empty(), "a shape has triangles");
  is_free_ = Eigen::VectorXd::Ones(rest_.cols());
  if (form == EnergyForm::published)
    build_sums(mesh);
  else
    build_integrals(mesh);
}

void DeformEnergy::build_sums(const TriangleMesh& mesh) {
  double sum = 0;
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    edges_.push_back({edge.a, edge.b, (rest_.col(edge.a) - rest_.col(edge.b)).norm()});
    sum += edges_.back().rest;
    if (edge.is_border()) continue;
    const std::array<VertexId, 4> vertices = {edge.a, edge.b, edge.across[0], edge.across[1]};
    dihedrals_.push_back({vertices, hinge_turn(vertices, rest_).angle});
  }
  unit_ = sum / static_cast<double>(edges_.size());
  recovery_factors_ = Eigen::VectorXd::Constant(rest_.cols(), 1 / (unit_ * unit_));
}

void DeformEnergy::build_integrals(const TriangleMesh& mesh) {
  unit_ = box_diagonal(rest_) / kUnitsInDiagonal;
  recovery_factors_ = vertex_areas(mesh) / std::pow(unit_, 4);
  const double per_area = 1 / (unit_ * unit_);
  membrane_.law = {per_area * kIsotropic.stretch_warp, per_area * kIsotropic.stretch_weft,
                   per_area * kIsotropic.shear, 0};
  membrane_.elements = membrane_elements(mesh);
  curvatures_ = curvature_elements(mesh);
}

void DeformEnergy::hold(const std::vector<VertexId>& vertices) {
  is_free_.setOnes();
  for (const VertexId v : vertices) is_free_[v] = 0;
}

DeformTerms DeformEnergy::terms(const Eigen::Ref<const Positions>& positions) const {
  PLEAT_CHECK(positions.cols() == rest_.cols(), "a position for each vertex");
  DeformTerms terms;
  terms.recovery =
      (positions - rest_).colwise().squaredNorm() * recovery_factors_.cwiseProduct(is_free_);
  terms.stretch = membrane_energy(membrane_, positions);
  for (const EdgeLength& edge : edges_) {
    const double change = (positions.col(edge.a) - positions.col(edge.b)).norm() - edge.rest;
    terms.stretch += change * change / (unit_ * unit_);
  }
  terms.bending = curvature_energy(curvatures_, positions);
  for (const Dihedral& dihedral : dihedrals_) {
    const double change = hinge_turn(dihedral.vertices, positions).angle - dihedral.rest;
    terms.bending += change * change;
  }
  return terms;
}

Positions DeformEnergy::gradient(const DeformWeights& weights,
                                 const Eigen::Ref<const Positions>& positions) const {
  Positions gradient = Positions::Zero(3, positions.cols());
  if (weights.stretch > 0) {
    add_membrane_forces(membrane_, positions, gradient);
    gradient *= -weights.stretch;
    for (const EdgeLength& edge : edges_) {
      const Vec3 along = positions.col(edge.a) - positions.col(edge.b);
      const double length = along.norm();
      if (length == 0) continue;  // no direction to grow in
      const Vec3 pull = 2 * weights.stretch * (1 - edge.rest / length) / (unit_ * unit_) * along;
      gradient.col(edge.a) += pull;
      gradient.col(edge.b) -= pull;
    }
  }
  if (weights.recovery > 0)
    gradient += 2 * weights.recovery * (positions - rest_) *
                recovery_factors_.cwiseProduct(is_free_).asDiagonal();
  if (weights.bending > 0) {
    add_curvature_gradient(curvatures_, weights.bending, positions, gradient);
    for (const Dihedral& dihedral : dihedrals_) {
      const HingeTurn turn = hinge_turn(dihedral.vertices, positions);
      const double moment = 2 * weights.bending * (turn.angle - dihedral.rest);
      for (int k = 0; k < 4; ++k)
        gradient.col(dihedral.vertices[static_cast<std::size_t>(k)]) +=
            moment * turn.gradient.col(k);
    }
  }
  return gradient;
}

std::vector<VertexMatrix::Pair> DeformEnergy::joined_pairs(const DeformWeights& weights) const {
  std::vector<VertexMatrix::Pair> pairs;
  if (weights.stretch > 0) {
    for (const EdgeLength& edge : edges_) pairs.push_back({edge.a, edge.b});
    for (const MembraneElement& element : membrane_.elements) join_all(element.vertices, pairs);
  }
  if (weights.bending > 0) {
    for (const Dihedral& dihedral : dihedrals_) join_all(dihedral.vertices, pairs);
    for (const CurvatureElement& element : curvatures_) join_all(element.vertices, pairs);
  }
  return pairs;
}

void DeformEnergy::add_gauss_newton(const DeformWeights& weights,
                                    const Eigen::Ref<const Positions>& positions,
                                    VertexMatrix& matrix) const {
  const Eigen::VectorXd recovery = 2 * weights.recovery * recovery_factors_;
  for (Eigen::Index v = 0; v < recovery.size(); ++v)
    matrix.add_to_diagonal(VertexId(v), is_free_[v] * recovery[v]);
  if (weights.stretch > 0) {
    for (const MembraneElement& element : membrane_.elements)
      add_element(matrix, element.vertices,
                  weights.stretch * membrane_stiffness(membrane_.law, element, positions,
                                                       ElementHessian::projected));
    for (const EdgeLength& edge : edges_) {
      const Vec3 along = positions.col(edge.a) - positions.col(edge.b);
      if (along.isZero(0)) continue;
      const Vec3 u = along.normalized();
      const double tension = std::max(0.0, 1 - edge.rest / along.norm());
      const Mat3 block = 2 * weights.stretch / (unit_ * unit_) *
                         (tension * Mat3::Identity() + (1 - tension) * u * u.transpose());
      matrix.add_diagonal(edge.a, block);
      matrix.add_diagonal(edge.b, block);
      matrix.add_block(matrix.slot(edge.a, edge.b), -block);
    }
  }
  if (weights.bending > 0) {
    add_curvature_gauss_newton(curvatures_, weights.bending, positions, matrix);
    for (const Dihedral& dihedral : dihedrals_) {
      const HingeTurn turn = hinge_turn(dihedral.vertices, positions);
      const Eigen::Matrix<double, 12, 1> row = turn.gradient.reshaped();
      add_element<4>(matrix, dihedral.vertices, 2 * weights.bending * row * row.transpose());
    }
  }
}

}  // namespace pleat
