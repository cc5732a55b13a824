#include "core/modal/surface_arap.h"

#include <algorithm>

#include "core/base/check.h"

namespace pleat {
namespace {

struct Spoke {
  VertexId end;
  double weight;
};

double cotangent(const Vec3& a, const Vec3& b) {
  const double area = a.cross(b).norm();
  return area > 0 ? a.dot(b) / area : 0;
}

/// Edges around each vertex, with half the cotangents of the angles across.
std::vector<std::vector<Spoke>> spokes(const Positions& x, const std::vector<Triangle>& triangles) {
  std::vector<std::vector<Spoke>> around(static_cast<std::size_t>(x.cols()));
  for (const MeshEdge& edge : mesh_edges(triangles)) {
    double weight = 0;
    for (std::size_t side = 0; side < 2; ++side) {
      if (!edge.faces[side].valid()) continue;
      const Vec3 corner = x.col(edge.across[side]);
      weight += cotangent(x.col(edge.a) - corner, x.col(edge.b) - corner) / 2;
    }
    weight = std::max(weight, 0.0);
    around[static_cast<std::size_t>(edge.a)].push_back({edge.b, weight});
    around[static_cast<std::size_t>(edge.b)].push_back({edge.a, weight});
  }
  return around;
}

Mat3 cross_matrix(const Vec3& a) {
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

}  // namespace

// A small turn omega adds omega x p to a spoke p. For moves u_j of a star about its centre, d_j =
// u_j
// - u_v, the least of sum w |d - omega x p|^2 is sum w |d|^2 - b' A^+ b with b = sum w p x d and
// A = sum w (|p|^2 I - p p').
SparseMatrix surface_arap_hessian(const Positions& positions,
                                  const std::vector<Triangle>& triangles, double stiffness) {
  PLEAT_CHECK(stiffness > 0, "a stiffness is positive");
  std::vector<Eigen::Triplet<double, int>> entries;
  const auto around = spokes(positions, triangles);
  for (int v = 0; v < positions.cols(); ++v) {
    const std::vector<Spoke>& star = around[static_cast<std::size_t>(v)];
    if (star.empty()) continue;
    const auto n = static_cast<Eigen::Index>(star.size()) + 1;  // the centre is the last
    Mat3 inertia = Mat3::Zero();
    Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(3, 3 * n);
    Eigen::MatrixXd block = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    for (Eigen::Index j = 0; j + 1 < n; ++j) {
      const auto& [end, weight] = star[static_cast<std::size_t>(j)];
      const Mat3 cross = weight * cross_matrix(positions.col(end) - positions.col(v));
      const Vec3 p = positions.col(end) - positions.col(v);
      inertia += weight * (p.squaredNorm() * Mat3::Identity() - p * p.transpose());
      moments.middleCols<3>(3 * j) = cross;
      moments.rightCols<3>() -= cross;
      for (const auto& [row, column, sign] : {std::tuple(j, j, 1), std::tuple(n - 1, n - 1, 1),
                                              std::tuple(j, n - 1, -1), std::tuple(n - 1, j, -1)})
        block.block<3, 3>(3 * row, 3 * column) += sign * weight * Mat3::Identity();
    }
    block -= moments.transpose() * inertia.completeOrthogonalDecomposition().solve(moments);
    const auto vertex = [&](Eigen::Index j) {
      return j + 1 < n ? static_cast<int>(star[static_cast<std::size_t>(j)].end) : v;
    };
    for (Eigen::Index a = 0; a < 3 * n; ++a)
      for (Eigen::Index b = 0; b < 3 * n; ++b) {
        const int row = 3 * vertex(a / 3) + static_cast<int>(a % 3);
        const int column = 3 * vertex(b / 3) + static_cast<int>(b % 3);
        if (row >= column) entries.emplace_back(row, column, 2 * stiffness * block(a, b));
      }
  }
  const int n = 3 * static_cast<int>(positions.cols());
  SparseMatrix hessian(n, n);
  hessian.setFromTriplets(entries.begin(), entries.end());
  return hessian;
}

Eigen::VectorXd surface_areas(const Positions& positions, const std::vector<Triangle>& triangles) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(positions.cols());
  for (const auto& [a, b, c] : triangles) {
    const Vec3 ab = positions.col(b) - positions.col(a);
    const double third = ab.cross(positions.col(c) - positions.col(a)).norm() / 6;
    for (const VertexId v : {a, b, c}) areas[v] += third;
  }
  return areas;
}

}  // namespace pleat
