#include "core/modal/tet_element.h"

#include <Eigen/LU>

#include "core/base/check.h"

namespace pleat {

Mat3 TetElement::deformation_gradient(const Positions& positions) const {
  Mat3 F = Mat3::Zero();
  for (int k = 0; k < 4; ++k)
    F += positions.col(tet[static_cast<std::size_t>(k)]) * to_gradient.row(k);
  return F;
}

void TetElement::add_pulls(const Mat3& stress, Positions& pulls) const {
  const Eigen::Matrix<double, 3, 4> own = volume * stress * to_gradient.transpose();
  for (int k = 0; k < 4; ++k) pulls.col(tet[static_cast<std::size_t>(k)]) += own.col(k);
}

std::vector<TetElement> tet_elements(const TetMesh& rest) {
  std::vector<TetElement> elements;
  elements.reserve(rest.tets.size());
  for (const Tet& tet : rest.tets) {
    const double volume = tet_volume(rest.rest_positions, tet);
    PLEAT_CHECK(volume > 0, "a tetrahedron at rest has volume");
    const Mat3 inverse = tet_edges(rest.rest_positions, tet).inverse();
    TetElement element{tet, {}, volume};
    element.to_gradient.bottomRows<3>() = inverse;
    element.to_gradient.row(0) = -inverse.colwise().sum();
    elements.push_back(element);
  }
  return elements;
}

SparseMatrix laplacian(int n_vertices, const std::vector<TetElement>& elements) {
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(10 * elements.size());
  for (const TetElement& element : elements) {
    const Eigen::Matrix4d block =
        element.volume * element.to_gradient * element.to_gradient.transpose();
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        const int row = element.tet[static_cast<std::size_t>(a)];
        const int column = element.tet[static_cast<std::size_t>(b)];
        if (row >= column) entries.emplace_back(row, column, block(a, b));
      }
  }
  SparseMatrix lower(n_vertices, n_vertices);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

}  // namespace pleat
