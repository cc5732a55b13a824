#include "core/deform/deform_energy.h"

#include <cmath>

#include "core/base/check.h"
#include "core/deform/cloth_extent.h"
#include "core/fabric/hinge_bending.h"

namespace pleat {
namespace {

constexpr double kUnitsInExtent = 20;  // units of length in the extent, for the consistent form
/// lambda = mu = 1 in lambda/2 tr(E)^2 + mu E:E, as the membrane's law writes it.
constexpr MembraneLaw kIsotropic = {3, 3, 1, 0};

/// Adds a value for each pair of an element's vertices.
template <std::size_t n, class Value>
void add_pairs(const std::array<VertexId, n>& vertices, Value&& value, SparseMatrix& lower) {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      lower.coeffRef(std::max(vertices[i], vertices[j]), std::min(vertices[i], vertices[j])) +=
          value(i, j);
}

/// Entries on the diagonal and for the pairs, all zero.
template <std::size_t n>
void join(const std::array<VertexId, n>& vertices, std::vector<Eigen::Triplet<double>>& entries) {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      entries.emplace_back(std::max(vertices[i], vertices[j]), std::min(vertices[i], vertices[j]),
                           0.0);
}

}  // namespace

DeformEnergy::DeformEnergy(const TriangleMesh& mesh, EnergyForm form) : rest_(mesh.rest_positions) {
  PLEAT_CHECK(!mesh.triangles.empty(), "a shape has triangles");
  is_free_ = Eigen::VectorXd::Ones(rest_.cols());
  bending_metric_.resize(mesh.n_vertices(), mesh.n_vertices());
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
  unit_ = cloth_extent(mesh) / kUnitsInExtent;
  recovery_factors_ = vertex_areas(mesh) / std::pow(unit_, 4);
  const double per_area = 1 / (unit_ * unit_);
  membrane_.law = {per_area * kIsotropic.stretch_warp, per_area * kIsotropic.stretch_weft,
                   per_area * kIsotropic.shear, 0};
  membrane_.elements = membrane_elements(mesh);
  curvatures_ = curvature_elements(mesh);
  bending_metric_ = curvature_metric(curvatures_, mesh.n_vertices());
}

void DeformEnergy::hold(const std::vector<VertexId>& vertices) {
  is_free_.setOnes();
  for (const VertexId v : vertices) is_free_[v] = 0;
}

DeformTerms DeformEnergy::terms(const PositionsView& positions) const {
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

Eigen::VectorXd DeformEnergy::bending_shares(const PositionsView& positions) const {
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(positions.cols());
  add_curvature_shares(curvatures_, positions, shares);
  for (const Dihedral& dihedral : dihedrals_) {
    const double change = hinge_turn(dihedral.vertices, positions).angle - dihedral.rest;
    for (int end = 0; end < 2; ++end)
      shares[dihedral.vertices[static_cast<std::size_t>(end)]] += change * change / 2;
  }
  return shares;
}

void DeformEnergy::add_stretch_gradient(double weight, const PositionsView& positions,
                                        Positions& gradient) const {
  Positions forces = Positions::Zero(3, positions.cols());
  add_membrane_forces(membrane_, positions, forces);
  gradient -= weight * forces;
  for (const EdgeLength& edge : edges_) {
    const Vec3 along = positions.col(edge.a) - positions.col(edge.b);
    const double length = along.norm();
    if (length == 0) continue;  // no direction to grow in
    const Vec3 pull = 2 * weight * (1 - edge.rest / length) / (unit_ * unit_) * along;
    gradient.col(edge.a) += pull;
    gradient.col(edge.b) -= pull;
  }
}

void DeformEnergy::add_bending_gradient(double weight, const PositionsView& positions,
                                        Positions& gradient) const {
  add_curvature_gradient(curvatures_, weight, positions, gradient);
  for (const Dihedral& dihedral : dihedrals_) {
    const HingeTurn turn = hinge_turn(dihedral.vertices, positions);
    const double moment = 2 * weight * (turn.angle - dihedral.rest);
    for (int k = 0; k < 4; ++k)
      gradient.col(dihedral.vertices[static_cast<std::size_t>(k)]) += moment * turn.gradient.col(k);
  }
}

Positions DeformEnergy::gradient(const DeformWeights& weights,
                                 const PositionsView& positions) const {
  Positions gradient = Positions::Zero(3, positions.cols());
  if (weights.stretch > 0) add_stretch_gradient(weights.stretch, positions, gradient);
  if (weights.recovery > 0)
    gradient += 2 * weights.recovery * (positions - rest_) *
                recovery_factors_.cwiseProduct(is_free_).asDiagonal();
  if (weights.bending > 0) add_bending_gradient(weights.bending, positions, gradient);
  return gradient;
}

/// An entry for each pair of vertices that terms with a weight join, zero but for the shares of
/// recovery and curvature, which do not depend on the positions.
SparseMatrix DeformEnergy::constant_metric(const DeformWeights& weights) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index v = 0; v < rest_.cols(); ++v)
    entries.emplace_back(static_cast<int>(v), static_cast<int>(v), 0.0);
  if (weights.stretch > 0) {
    for (const EdgeLength& edge : edges_) join(std::array{edge.a, edge.b}, entries);
    for (const MembraneElement& element : membrane_.elements) join(element.vertices, entries);
  }
  if (weights.bending > 0)
    for (const Dihedral& dihedral : dihedrals_) join(dihedral.vertices, entries);
  SparseMatrix lower(static_cast<int>(rest_.cols()), static_cast<int>(rest_.cols()));
  lower.setFromTriplets(entries.begin(), entries.end());
  if (weights.bending > 0) lower += weights.bending * bending_metric_;
  lower.diagonal() += 2 * weights.recovery * recovery_factors_.cwiseProduct(is_free_);
  return lower;
}

void DeformEnergy::add_stretch_metric(double weight, const PositionsView& positions,
                                      SparseMatrix& lower) const {
  for (const MembraneElement& element : membrane_.elements) {
    const auto block =
        membrane_stiffness(membrane_.law, element, positions, ElementHessian::projected);
    add_pairs(
        element.vertices,
        [&](std::size_t i, std::size_t j) {
          return weight / 3 * block.block<3, 3>(3 * i, 3 * j).trace();
        },
        lower);
  }
  for (const EdgeLength& edge : edges_) {
    const double length = (positions.col(edge.a) - positions.col(edge.b)).norm();
    const double tension = length > edge.rest ? 1 - edge.rest / length : 0;
    const double stiffness = 2 * weight / (unit_ * unit_) * (1 + 2 * tension) / 3;
    add_pairs(
        std::array{edge.a, edge.b},
        [&](std::size_t i, std::size_t j) { return i == j ? stiffness : -stiffness; }, lower);
  }
}

void DeformEnergy::add_turn_metric(double weight, const PositionsView& positions,
                                   SparseMatrix& lower) const {
  for (const Dihedral& dihedral : dihedrals_) {
    const HingeTurn turn = hinge_turn(dihedral.vertices, positions);
    add_pairs(
        dihedral.vertices,
        [&](std::size_t i, std::size_t j) {
          return 2 * weight / 3 *
                 turn.gradient.col(static_cast<Eigen::Index>(i))
                     .dot(turn.gradient.col(static_cast<Eigen::Index>(j)));
        },
        lower);
  }
}

SparseMatrix DeformEnergy::metric(const DeformWeights& weights,
                                  const PositionsView& positions) const {
  SparseMatrix lower = constant_metric(weights);
  if (weights.stretch > 0) add_stretch_metric(weights.stretch, positions, lower);
  if (weights.bending > 0) add_turn_metric(weights.bending, positions, lower);
  return lower;
}

}  // namespace pleat
