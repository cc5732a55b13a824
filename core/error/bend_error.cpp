#include "core/error/bend_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/check.h"

namespace pleat {
namespace {

constexpr int kRegionsAlongSide = 4;

/// Curvature vectors k_ww, k_ff, k_wf of each triangle, one below the other.
using CurvatureVectors = Eigen::Matrix<double, 9, Eigen::Dynamic>;

Positions centroids(const TriangleMesh& mesh) {
  const Positions& x = mesh.rest_positions;
  Positions c(3, static_cast<Eigen::Index>(mesh.triangles.size()));
  for (Eigen::Index t = 0; t < c.cols(); ++t) {
    const Triangle& corners = mesh.triangles[static_cast<std::size_t>(t)];
    c.col(t) = (x.col(corners[0]) + x.col(corners[1]) + x.col(corners[2])) / 3;
  }
  return c;
}

/// The triangles beyond the edges of each.
std::vector<std::vector<FaceId>> adjacent_triangles(const TriangleMesh& mesh) {
  std::vector<std::vector<FaceId>> adjacent(mesh.triangles.size());
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    if (edge.is_border()) continue;
    adjacent[edge.faces[0]].push_back(edge.faces[1]);
    adjacent[edge.faces[1]].push_back(edge.faces[0]);
  }
  return adjacent;
}

/// Warp and weft of a triangle, as rows.
Eigen::Matrix<double, 2, 3> thread_directions(const TriangleMesh& mesh, std::size_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const Vec3 x0 = mesh.rest_positions.col(t[0]);
  const Vec3 normal =
      (mesh.rest_positions.col(t[1]) - x0).cross(mesh.rest_positions.col(t[2]) - x0);
  Eigen::Matrix<double, 2, 3> directions;
  directions.row(0) = mesh.warp_directions[triangle].transpose();
  directions.row(1) = normal.normalized().cross(mesh.warp_directions[triangle]).transpose();
  return directions;
}

/// Boxes of the rest shape, kRegionsAlongSide along each of its sides, numbered from 0 without
/// gaps.
std::vector<int> box_regions(const Positions& points, int& n_regions) {
  constexpr double kFlat = 1e-6;  // share of the longest side; a sheet's thickness by rounding
  const Vec3 low = points.rowwise().minCoeff();
  const Vec3 sides = points.rowwise().maxCoeff() - low;
  const double flat = kFlat * sides.maxCoeff();
  std::vector<int> numbers(kRegionsAlongSide * kRegionsAlongSide * kRegionsAlongSide, -1);
  std::vector<int> regions;
  n_regions = 0;
  for (const auto& point : points.colwise()) {
    int box = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double share = sides[axis] > flat ? (point[axis] - low[axis]) / sides[axis] : 0;
      const int place = static_cast<int>(share * kRegionsAlongSide);
      box = box * kRegionsAlongSide + std::min(place, kRegionsAlongSide - 1);
    }
    int& number = numbers[static_cast<std::size_t>(box)];
    if (number < 0) number = n_regions++;
    regions.push_back(number);
  }
  return regions;
}

std::vector<Eigen::Index> ascending(const VectorView& values) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&values](Eigen::Index i, Eigen::Index j) { return values[i] < values[j]; });
  return order;
}

}  // namespace

// Curvature is a second derivative, and second derivatives of a smoothed surface are the smoothed
// ones: it is the curvature vectors that are averaged, so that nothing is drawn in at a border.
// Weights are (1 - |w|/r) (1 - |f|/r) times the area, with w and f the offsets along warp and weft:
// along a line such an average of x'' is (x(-r) - 2 x(0) + x(r))/r^2, what the coarsest mesh sees.
BendMeasure::BendMeasure(const TriangleMesh& mesh, double radius)
    : stencils_(curvature_stencils(mesh)), areas_(stencils_.size()) {
  PLEAT_CHECK(radius > 0 && !stencils_.empty(), "a mesh is smoothed over a radius");
  const std::size_t n_triangles = stencils_.size();
  for (std::size_t t = 0; t < n_triangles; ++t)
    areas_[static_cast<Eigen::Index>(t)] = stencils_[t].area;
  const Positions points = centroids(mesh);
  regions_ = box_regions(points, n_regions_);
  const std::vector<std::vector<FaceId>> adjacent = adjacent_triangles(mesh);

  std::vector<std::size_t> reached_from(n_triangles, n_triangles);
  std::vector<FaceId> queue;
  for (std::size_t t = 0; t < n_triangles; ++t) {
    const Eigen::Matrix<double, 2, 3> threads = thread_directions(mesh, t);
    const std::size_t begin = neighbours_.size();
    double sum = 0;
    queue.assign(1, FaceId(static_cast<std::int64_t>(t)));
    reached_from[t] = t;
    for (std::size_t next = 0; next < queue.size(); ++next) {  // the queue grows meanwhile
      const FaceId face = queue[next];
      const Eigen::Vector2d offset =
          threads * (points.col(face) - points.col(static_cast<Eigen::Index>(t)));
      const Eigen::Vector2d hat = Eigen::Vector2d::Ones() - offset.cwiseAbs() / radius;
      if (hat.minCoeff() <= 0) continue;
      neighbours_.push_back({face.value, areas_[face] * hat.prod()});
      sum += neighbours_.back().weight;
      for (const FaceId beyond : adjacent[face]) {
        if (reached_from[beyond] == t) continue;
        reached_from[beyond] = t;
        queue.push_back(beyond);
      }
    }
    for (std::size_t n = begin; n < neighbours_.size(); ++n) neighbours_[n].weight /= sum;
    ends_.push_back(neighbours_.size());
  }
}

Eigen::VectorXd BendMeasure::curvatures(const PositionsView& positions) const {
  CurvatureVectors vectors = CurvatureVectors::Zero(9, areas_.size());
  for (std::size_t t = 0; t < stencils_.size(); ++t) {
    Eigen::Map<Mat3> columns(vectors.col(static_cast<Eigen::Index>(t)).data());
    for (std::size_t k = 0; k < stencils_[t].vertices.size(); ++k)
      columns += positions.col(stencils_[t].vertices[k]) *
                 stencils_[t].weights.col(static_cast<Eigen::Index>(k)).transpose();
  }
  Eigen::VectorXd magnitudes(areas_.size());
  std::size_t n = 0;
  for (std::size_t t = 0; t < ends_.size(); ++t) {
    Vec9 mean = Vec9::Zero();
    for (; n < ends_[t]; ++n) mean += neighbours_[n].weight * vectors.col(neighbours_[n].triangle);
    magnitudes[static_cast<Eigen::Index>(t)] =
        std::sqrt(mean.head<6>().squaredNorm() + 2 * mean.tail<3>().squaredNorm());
  }
  return magnitudes;
}

BendError BendMeasure::error(const PositionsView& positions, const PositionsView& reference) const {
  PLEAT_CHECK(positions.allFinite() && reference.allFinite(), "a surface is at finite places");
  const Eigen::VectorXd own = curvatures(positions);
  const Eigen::VectorXd theirs = curvatures(reference);
  Eigen::VectorXd differences = Eigen::VectorXd::Zero(n_regions_);  // times area
  for (Eigen::Index t = 0; t < areas_.size(); ++t)
    differences[regions_[static_cast<std::size_t>(t)]] += areas_[t] * (own[t] - theirs[t]);
  return {wasserstein_distance(own, theirs, areas_), differences.lpNorm<1>() / areas_.sum()};
}

// Area between the cumulative distributions, which the distance is in one dimension. Both are
// stepped through in ascending order; `ahead` is the weight by which a is ahead of b below `value`.
double wasserstein_distance(const VectorView& values_a, const VectorView& values_b,
                            const VectorView& weights) {
  PLEAT_CHECK(values_a.size() == weights.size() && values_b.size() == weights.size(),
              "each value has a weight");
  PLEAT_CHECK(weights.size() > 0 && weights.minCoeff() >= 0 && weights.sum() > 0,
              "weights are not negative, and there is some");
  const std::vector<Eigen::Index> order_a = ascending(values_a);
  const std::vector<Eigen::Index> order_b = ascending(values_b);
  double distance = 0;
  double ahead = 0;
  double value = std::min(values_a[order_a.front()], values_b[order_b.front()]);
  for (auto a = order_a.begin(), b = order_b.begin(); a != order_a.end() || b != order_b.end();) {
    const bool is_next_a =
        b == order_b.end() || (a != order_a.end() && values_a[*a] <= values_b[*b]);
    const double next = is_next_a ? values_a[*a] : values_b[*b];
    distance += std::abs(ahead) * (next - value);
    value = next;
    ahead += is_next_a ? weights[*a++] : -weights[*b++];
  }
  return distance / weights.sum();
}

Positions subdivided_positions(const PositionsView& positions,
                               std::span<const std::array<VertexId, 2>> middles) {
  const auto n_new = static_cast<Eigen::Index>(middles.size());
  Positions all(3, positions.cols() + n_new);
  all.leftCols(positions.cols()) = positions;
  for (Eigen::Index i = 0; i < n_new; ++i) {
    const auto& [a, b] = middles[static_cast<std::size_t>(i)];
    all.col(positions.cols() + i) = (all.col(a) + all.col(b)) / 2;
  }
  return all;
}

}  // namespace pleat
