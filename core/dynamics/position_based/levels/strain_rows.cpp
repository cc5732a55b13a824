#include "core/dynamics/position_based/levels/strain_rows.h"

#include <cmath>

namespace pleat {

StrainRows strain_rows(const StrainedEdges& coarser, const StrainedEdges& finer,
                       const Positions& rest) {
  std::vector<std::vector<int>> around(static_cast<std::size_t>(rest.cols()));
  for (std::size_t e = 0; e < finer.ends.size(); ++e)
    for (const VertexId v : finer.ends[e]) around[v].push_back(static_cast<int>(e));
  const auto direction = [&](const std::array<VertexId, 2>& ends) {
    return Vec3(rest.col(ends[1]) - rest.col(ends[0])).normalized();
  };
  StrainRows rows;
  for (std::size_t e = 0; e < coarser.ends.size(); ++e) {
    const Vec3 along = direction(coarser.ends[e]);
    double sum = 0;
    const std::size_t first = rows.weights.size();
    for (const VertexId v : coarser.ends[e])
      for (const int f : around[v]) {
        const double cosine = along.dot(direction(finer.ends[static_cast<std::size_t>(f)]));
        rows.columns.push_back(finer.places[static_cast<std::size_t>(f)]);
        rows.weights.push_back(std::pow(cosine, 8));
        sum += rows.weights.back();
      }
    for (std::size_t i = first; i < rows.weights.size(); ++i)
      rows.weights[i] = sum > 0 ? rows.weights[i] / sum : 0;
    rows.targets.push_back(coarser.places[e]);
    rows.row_ends.push_back(static_cast<int>(rows.columns.size()));
  }
  return rows;
}

}  // namespace pleat
