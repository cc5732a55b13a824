#include "core/deform/curvature_energy.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/fabric/balanced_stencil.h"
#include "core/fabric/membrane.h"

namespace pleat {
namespace {

const Vec3 kTensorWeights(1, 1, 2);  // weights of ww, ff, wf in the square of a symmetric tensor

using Corners = std::array<VertexId, 3>;

Mat3 cross_matrix(const Vec3& a) {
  Mat3 A;
  A << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return A;
}

/// A triangle's unit normal; its derivative by the corners [1/m].
struct Normal {
  Vec3 n = Vec3::Zero();
  std::array<Mat3, 3> by_corner = {Mat3::Zero(), Mat3::Zero(), Mat3::Zero()};
};

Corners corners(const CurvatureElement& element) {
  return {element.vertices[0], element.vertices[1], element.vertices[2]};
}

/// Normal and its derivatives. With the sides a, b at the first corner and D = a x b,
/// dD = a x db - b x da and dn = (I - n n^T) dD/|D|.
Normal normal_at(const Corners& t, const PositionsView& x) {
  constexpr double kNoArea = 1e-12;  // sine at the first corner; below it the normal is noise
  const Vec3 a = x.col(t[1]) - x.col(t[0]);
  const Vec3 b = x.col(t[2]) - x.col(t[0]);
  const Vec3 D = a.cross(b);
  Normal normal;
  if (!(D.norm() > kNoArea * a.norm() * b.norm())) return normal;
  normal.n = D.normalized();
  const Mat3 across = (Mat3::Identity() - normal.n * normal.n.transpose()) / D.norm();
  normal.by_corner[1] = -across * cross_matrix(b);
  normal.by_corner[2] = across * cross_matrix(a);
  normal.by_corner[0] = -normal.by_corner[1] - normal.by_corner[2];
  return normal;
}

/// Sum of w_i x_i: a column for each of ww, ff, wf. Weights add up to nothing, so that a vertex may
/// be the origin: cloth that lies far off keeps its digits.
Mat3 second_derivatives(const CurvatureElement& element, const PositionsView& x) {
  const Vec3 origin = x.col(element.vertices[0]);
  Mat3 k = Mat3::Zero();
  for (std::size_t i = 1; i < element.vertices.size(); ++i)
    k += (x.col(element.vertices[i]) - origin) *
         element.weights.col(static_cast<Eigen::Index>(i)).transpose();
  return k;
}

bool is_flat(const CurvatureElement& element) { return element.normal_part.isZero(0); }

Mat3 residuals(const CurvatureElement& element, const Normal& normal, const PositionsView& x) {
  return second_derivatives(element, x) - normal.n * element.normal_part.transpose();
}

Normal normal_if_needed(const CurvatureElement& element, const PositionsView& x) {
  return is_flat(element) ? Normal{} : normal_at(corners(element), x);
}

double energy_of(const CurvatureElement& element, const PositionsView& x) {
  const Mat3 r = residuals(element, normal_if_needed(element, x), x);
  return element.area * kTensorWeights.dot(r.colwise().squaredNorm().transpose());
}

/// The stencil with the triangle's corners first.
CurvatureElement reordered(const CurvatureStencil& stencil, const Corners& corners) {
  CurvatureElement element;
  element.area = stencil.area;
  element.vertices.assign(corners.begin(), corners.end());
  element.weights.setZero(3, static_cast<Eigen::Index>(stencil.vertices.size()) + 3);
  for (std::size_t i = 0; i < stencil.vertices.size(); ++i) {
    auto place = std::find(element.vertices.begin(), element.vertices.end(), stencil.vertices[i]);
    if (place == element.vertices.end())
      place = element.vertices.insert(place, stencil.vertices[i]);
    element.weights.col(place - element.vertices.begin()) =
        stencil.weights.col(static_cast<Eigen::Index>(i));
  }
  element.weights.conservativeResize(3, static_cast<Eigen::Index>(element.vertices.size()));
  return element;
}

/// Splits k_M = b n + F tau, F = (x_u, x_v) the derivatives along warp and weft. F is linear in the
/// positions: tau joins the weights.
void subtract_rest(CurvatureElement& element, const MembraneElement& face, const Vec3& warp,
                   const Positions& rest) {
  constexpr double kFlat = 1e-9;  // curvature times size; below it, what rounding leaves
  const Mat3 k = second_derivatives(element, rest);
  if (k.norm() * std::sqrt(element.area) < kFlat) return;
  const Vec3 normal = normal_at(corners(element), rest).n;
  element.normal_part = k.transpose() * normal;
  const Vec3 along_warp = k.transpose() * warp;
  const Vec3 along_weft = k.transpose() * normal.cross(warp);
  for (int i = 0; i < 3; ++i)
    element.weights.col(i) -= face.gradients(i, 0) * along_warp + face.gradients(i, 1) * along_weft;
}

}  // namespace

std::vector<CurvatureElement> curvature_elements(const TriangleMesh& mesh) {
  const std::vector<MembraneElement> faces = membrane_elements(mesh);
  const std::vector<CurvatureStencil> stencils = balanced_stencils(mesh);
  std::vector<CurvatureElement> elements;
  elements.reserve(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    elements.push_back(reordered(stencils[f], faces[f].vertices));
    subtract_rest(elements.back(), faces[f], mesh.warp_directions[f], mesh.rest_positions);
  }
  return elements;
}

double curvature_energy(std::span<const CurvatureElement> elements,
                        const PositionsView& positions) {
  double energy = 0;
  for (const CurvatureElement& element : elements) energy += energy_of(element, positions);
  return energy;
}

void add_curvature_shares(std::span<const CurvatureElement> elements,
                          const PositionsView& positions, Eigen::Ref<Eigen::VectorXd> shares) {
  for (const CurvatureElement& element : elements) {
    const double third = energy_of(element, positions) / 3;
    for (const VertexId v : corners(element)) shares[v] += third;
  }
}

void add_curvature_gradient(std::span<const CurvatureElement> elements, double factor,
                            const PositionsView& positions, PositionsRef gradient) {
  for (const CurvatureElement& element : elements) {
    const Normal normal = normal_if_needed(element, positions);
    const Mat3 pull = 2 * factor * element.area * residuals(element, normal, positions) *
                      kTensorWeights.asDiagonal();
    for (std::size_t i = 0; i < element.vertices.size(); ++i)
      gradient.col(element.vertices[i]) += pull * element.weights.col(static_cast<Eigen::Index>(i));
    if (is_flat(element)) continue;
    const Vec3 on_normal = pull * element.normal_part;
    for (std::size_t i = 0; i < 3; ++i)
      gradient.col(element.vertices[i]) -= normal.by_corner[i].transpose() * on_normal;
  }
}

SparseMatrix curvature_metric(std::span<const CurvatureElement> elements, int n_vertices) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const CurvatureElement& element : elements) {
    for (std::size_t i = 0; i < element.vertices.size(); ++i) {
      const Vec3 moment =
          2 * element.area *
          kTensorWeights.cwiseProduct(element.weights.col(static_cast<Eigen::Index>(i)));
      for (std::size_t j = 0; j < element.vertices.size(); ++j)
        if (element.vertices[i] >= element.vertices[j])
          entries.emplace_back(element.vertices[i], element.vertices[j],
                               moment.dot(element.weights.col(static_cast<Eigen::Index>(j))));
    }
  }
  SparseMatrix lower(n_vertices, n_vertices);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

}  // namespace pleat
