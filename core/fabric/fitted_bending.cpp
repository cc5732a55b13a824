#include "core/fabric/fitted_bending.h"

#include "core/base/check.h"
#include "core/fabric/balanced_stencil.h"

namespace pleat {

SparseMatrix fitted_bending(const TriangleMesh& mesh, double bend_warp, double bend_weft,
                            double bend_twist) {
  PLEAT_CHECK(bend_warp >= 0 && bend_weft >= 0 && bend_twist >= 0, "rigidities are not negative");
  const Vec3 rigidities(bend_warp, bend_weft, 2 * bend_twist);
  const int n = mesh.n_vertices();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(n) + 21 * mesh.triangles.size());  // six vertices each
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, 0.0);
  for (const CurvatureStencil& stencil : balanced_stencils(mesh)) {
    const std::vector<VertexId>& vertices = stencil.vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vec3 moment = stencil.area * rigidities.cwiseProduct(stencil.weights.col(i));
      for (std::size_t j = 0; j < vertices.size(); ++j) {
        if (vertices[i] < vertices[j]) continue;
        entries.emplace_back(vertices[i], vertices[j], moment.dot(stencil.weights.col(j)));
      }
    }
  }
  SparseMatrix Q(n, n);
  Q.setFromTriplets(entries.begin(), entries.end());
  return Q;
}

}  // namespace pleat
