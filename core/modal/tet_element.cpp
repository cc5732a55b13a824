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

}  // namespace pleat
