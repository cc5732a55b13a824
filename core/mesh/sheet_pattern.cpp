#include "core/mesh/sheet_pattern.h"

#include <algorithm>

namespace pleat {
namespace {

using Vertices = std::vector<VertexId>;

TriangleMesh one_way(const QuadMesh& quads) {
  TriangleMesh mesh{quads.rest_positions(), {}, {}};
  for (const QuadFace& face : quads.faces()) {
    const auto& [v0, v1, v2, v3] = face.corners;
    mesh.triangles.push_back({v0, v1, v2});
    mesh.triangles.push_back({v0, v2, v3});
  }
  return mesh;
}

TriangleMesh crossed(const QuadMesh& quads) {
  TriangleMesh mesh{quads.rest_positions(), {}, {}};
  VertexId middle(quads.n_vertices());
  mesh.rest_positions.conservativeResize(
      3, quads.n_vertices() + static_cast<Eigen::Index>(quads.faces().size()));
  for (const QuadFace& face : quads.faces()) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      sum += quads.rest_positions().col(face.corners[k]);
      mesh.triangles.push_back({face.corners[k], face.corners[(k + 1) % 4], middle});
    }
    mesh.rest_positions.col(middle) = sum / 4;
    ++middle.value;
  }
  return mesh;
}

/// The triangles between two rows, one of which has one vertex more and its inner ones between
/// those of the other.
void join_rows(const Vertices& upper, const Vertices& lower, std::vector<Triangle>& triangles) {
  for (std::size_t k = 0; k + 1 < std::max(upper.size(), lower.size()); ++k) {
    if (upper.size() < lower.size()) {
      triangles.push_back({upper[k], lower[k], lower[k + 1]});
      if (k + 1 < upper.size()) triangles.push_back({upper[k], lower[k + 1], upper[k + 1]});
    } else {
      triangles.push_back({upper[k], lower[k], upper[k + 1]});
      if (k + 1 < lower.size()) triangles.push_back({upper[k + 1], lower[k], lower[k + 1]});
    }
  }
}

TriangleMesh equilateral(const SheetShape& shape) {
  TriangleMesh mesh;
  mesh.rest_positions.resize(3, n_patterned_vertices(shape, SheetPattern::equilateral));
  int n = 0;
  Vertices above;
  for (int r = 0; r <= shape.rows; ++r) {
    const double u = shape.height * (static_cast<double>(r) / shape.rows);
    const double shift = r % 2 == 1 ? 0.5 : 0;  // share of a cell
    Vertices row;
    for (int c = 0; c <= shape.columns + r % 2; ++c) {
      const double cells = std::clamp(c - shift, 0.0, static_cast<double>(shape.columns));
      mesh.rest_positions.col(n) = shape.origin + u * shape.warp_direction +
                                   shape.width * (cells / shape.columns) * shape.weft_direction;
      row.emplace_back(n++);
    }
    if (r > 0) join_rows(above, row, mesh.triangles);
    above = std::move(row);
  }
  return mesh;
}

/// Equilateral rows too are checked as those of a quad mesh.
TriangleMesh cut_sheet(const SheetShape& shape, SheetPattern pattern) {
  const QuadMesh quads = QuadMesh::sheet(shape);
  switch (pattern) {
    case SheetPattern::one_way:
      return one_way(quads);
    case SheetPattern::alternating:
      return quads.triangle_mesh();
    case SheetPattern::crossed:
      return crossed(quads);
    case SheetPattern::equilateral:
      return equilateral(shape);
  }
  return {};
}

}  // namespace

std::int64_t n_patterned_vertices(const SheetShape& shape, SheetPattern pattern) {
  const std::int64_t columns = shape.columns;
  const std::int64_t rows = shape.rows;
  const std::int64_t n_grid = (columns + 1) * (rows + 1);
  if (pattern == SheetPattern::crossed) return n_grid + columns * rows;
  if (pattern == SheetPattern::equilateral) return n_grid + (rows + 1) / 2;
  return n_grid;
}

TriangleMesh patterned_sheet(const SheetShape& shape, SheetPattern pattern) {
  TriangleMesh mesh = cut_sheet(shape, pattern);
  mesh.warp_directions.assign(mesh.triangles.size(), shape.warp_direction);
  return mesh;
}

}  // namespace pleat
