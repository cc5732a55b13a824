#include "core/model/stretch.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/mesh/mesh_lines.h"

namespace pleat {

double strain(const GaugeEdge& edge, const PositionsView& positions) {
  return (positions.col(edge.a) - positions.col(edge.b)).norm() / edge.rest_length - 1;
}

std::vector<GaugeEdge> gauge_edges(const QuadMesh& mesh) {
  std::vector<GaugeEdge> edges;
  for (const ThreadEdge& edge : thread_edges(mesh).edges)
    edges.push_back({edge.from, edge.to, edge.length});
  return edges;
}

std::vector<GaugeEdge> gauge_edges(const TriangleMesh& mesh) {
  std::vector<GaugeEdge> edges;
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    const double length = rest_length(mesh, edge);
    if (length > 0) edges.push_back({edge.a, edge.b, length});
  }
  return edges;
}

std::vector<GaugeEdge> gauge_edges(std::span<const Spring> springs) {
  std::vector<GaugeEdge> edges;
  for (const Spring& spring : springs)
    if (is_structural(spring.kind) && spring.rest_length > 0)
      edges.push_back({spring.a, spring.b, spring.rest_length});
  return edges;
}

Stretch stretch(std::span<const GaugeEdge> gauge, const PositionsView& positions) {
  if (gauge.empty()) return {};
  double sum = 0;
  double largest = 0;
  for (const GaugeEdge& edge : gauge) {
    const double e = std::abs(strain(edge, positions));
    sum += e * e;
    largest = std::max(largest, e);
  }
  return {std::sqrt(sum / static_cast<double>(gauge.size())), largest};
}

StrainMap::StrainMap(std::span<const GaugeEdge> gauge, int n_vertices)
    : gauge_(gauge.begin(), gauge.end()),
      inverse_counts_(static_cast<std::size_t>(n_vertices)),
      strains_(static_cast<std::size_t>(n_vertices)) {
  for (const GaugeEdge& edge : gauge_) {
    ++inverse_counts_[edge.a];
    ++inverse_counts_[edge.b];
  }
  for (float& count : inverse_counts_) count = count > 0 ? 1 / count : 0;
}

const std::vector<float>& StrainMap::update(const PositionsView& positions) {
  PLEAT_CHECK(static_cast<std::size_t>(positions.cols()) == strains_.size(),
              "a strain map keeps its number of vertices");
  std::fill(strains_.begin(), strains_.end(), 0.0F);
  for (const GaugeEdge& edge : gauge_) {
    const auto e = static_cast<float>(strain(edge, positions));
    strains_[edge.a] += e;
    strains_[edge.b] += e;
  }
  for (std::size_t i = 0; i < strains_.size(); ++i) strains_[i] *= inverse_counts_[i];
  return strains_;
}

}  // namespace pleat
