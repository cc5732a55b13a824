#include "native-tests/support/bent_sheets.h"

#include <cmath>

namespace pleat {

Positions folded(const QuadMesh& mesh, double place, double amplitude, double width) {
  constexpr int kSteps = 2048;  // a multiple of the cells along warp of any test's mesh
  Positions line(3, kSteps + 1);
  line.col(0).setZero();
  for (int i = 0; i < kSteps; ++i) {
    const double u = ((i + 0.5) / kSteps - place) / width;
    const double slope = amplitude * u * std::exp(-u * u / 2);
    line.col(i + 1) = line.col(i) + Vec3(std::cos(slope), 0, std::sin(slope)) / kSteps;
  }
  Positions x(3, mesh.n_vertices());
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    x.col(v) = line.col(std::lround(mesh.rest_coordinates()(0, v) * kSteps));
    x(1, v) = mesh.rest_coordinates()(1, v);
  }
  return x;
}

BendExample example_of_patterns(const QuadMesh& fine, const std::vector<int>& base_patterns,
                                int n_patterns) {
  BendExample example;
  example.name = "by hand";
  example.patterns.of_vertices = base_patterns;
  example.patterns.of_vertices.resize(static_cast<std::size_t>(fine.n_vertices()), 0);
  example.patterns.centres.resize(2, n_patterns);
  for (int p = 0; p < n_patterns; ++p) example.patterns.centres.col(p) << p, 0.1 * p;
  example.features = BendFeatures::Zero(2, fine.n_vertices());
  return example;
}

}  // namespace pleat
