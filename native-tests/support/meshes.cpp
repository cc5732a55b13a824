#include "native-tests/support/meshes.h"

#include <cmath>
#include <vector>

namespace pleat {
namespace {

/// Vertices of a polyline of `n` edges of length `edge` that turns by `turn` at each vertex.
std::vector<Eigen::Vector2d> turning_line(int n, double edge, double turn) {
  std::vector<Eigen::Vector2d> line{Eigen::Vector2d::Zero()};
  for (int i = 0; i < n; ++i)
    line.emplace_back(line.back() + edge * Eigen::Vector2d(std::cos(i * turn), std::sin(i * turn)));
  return line;
}

/// Rest coordinate `thread` follows the line, the other stays straight.
Positions rolled(const QuadMesh& mesh, int thread, int cells, double turn) {
  const RestCoordinates& uv = mesh.rest_coordinates();
  const double edge = uv.row(thread).maxCoeff() / cells;
  const std::vector<Eigen::Vector2d> line = turning_line(cells, edge, turn);
  Positions x(3, mesh.n_vertices());
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const auto place = static_cast<std::size_t>(std::lround(uv(thread, i) / edge));
    x.col(i) << line[place].x(), line[place].y(), uv(1 - thread, i);
  }
  return x;
}

/// Vertices and cells of a grid whose rows are sheared by `shift` cells each, in units of cells.
TriangleMesh cut_grid(Triangulation pattern, int rows, int columns, double shift) {
  TriangleMesh mesh;
  const int line = columns + 1;
  const bool has_middles = pattern == Triangulation::crossed;
  mesh.rest_positions.resize(3, line * (rows + 1) + (has_middles ? rows * columns : 0));
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) mesh.rest_positions.col(r * line + c) << c + shift * r, r, 0;
  const auto add = [&](int a, int b, int c) {
    mesh.triangles.push_back({VertexId(a), VertexId(b), VertexId(c)});
  };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const int v0 = r * line + c;
      const int v1 = v0 + 1;
      const int v2 = v1 + line;
      const int v3 = v0 + line;
      if (has_middles) {
        const int middle = line * (rows + 1) + r * columns + c;
        mesh.rest_positions.col(middle) << c + 0.5, r + 0.5, 0;
        for (const auto& [a, b] : {std::pair(v0, v1), {v1, v2}, {v2, v3}, {v3, v0}})
          add(a, b, middle);
      } else if (pattern == Triangulation::alternating && (r + c) % 2 == 0) {
        add(v0, v1, v2);
        add(v0, v2, v3);
      } else {
        add(v0, v1, v3);
        add(v1, v2, v3);
      }
    }
  }
  return mesh;
}

/// Angle at `corner` between the arms to a and b, all in the plane [rad].
double angle_at(const Positions& x, VertexId corner, VertexId a, VertexId b) {
  const Vec3 to_a = x.col(a) - x.col(corner);
  const Vec3 to_b = x.col(b) - x.col(corner);
  return std::atan2(to_a.cross(to_b).norm(), to_a.dot(to_b));
}

/// Flips one edge whose opposite angles sum to more than a half turn; false when there is none.
bool flip_one(TriangleMesh& mesh) {
  constexpr double kHalfTurn = 3.141592653589793 + 1e-9;  // ties are left as they are
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    if (edge.is_border()) continue;
    const auto& [c, d] = edge.across;
    const Positions& x = mesh.rest_positions;
    if (angle_at(x, c, edge.a, edge.b) + angle_at(x, d, edge.a, edge.b) <= kHalfTurn) continue;
    mesh.triangles[edge.faces[0]] = {c, edge.a, d};
    mesh.triangles[edge.faces[1]] = {d, edge.b, c};
    return true;
  }
  return false;
}

}  // namespace

QuadMesh square_sheet(int cells) {
  SheetShape shape;
  shape.rows = cells;
  shape.columns = cells;
  return QuadMesh::sheet(shape);
}

QuadMesh lying_sheet(int cells) {
  SheetShape shape;
  shape.rows = shape.columns = cells;
  shape.warp_direction = {1, 0, 0};
  shape.weft_direction = {0, 1, 0};
  return QuadMesh::sheet(shape);
}

QuadMesh sheet_with_aspect(int rows, int columns, double aspect) {
  SheetShape shape;
  shape.rows = rows;
  shape.columns = columns;
  shape.height = aspect * rows / columns;
  return QuadMesh::sheet(shape);
}

Positions shaken(const Positions& x, double amount, Random& random) {
  Positions moved = x;
  for (double& coordinate : moved.reshaped()) coordinate += random.uniform(-amount, amount);
  return moved;
}

Positions rolled_along_warp(const QuadMesh& mesh, int rows, double turn) {
  return rolled(mesh, 0, rows, turn);
}

Positions rolled_along_weft(const QuadMesh& mesh, int columns, double turn) {
  return rolled(mesh, 1, columns, turn);
}

TriangleMesh triangulated_sheet(Triangulation pattern, int rows, int columns, double edge) {
  constexpr double kJitter = 0.25;  // share of an edge, each way: no triangle turns over
  const bool is_sheared =
      pattern == Triangulation::equilateral || pattern == Triangulation::jittered;
  TriangleMesh mesh = cut_grid(pattern, rows, columns, is_sheared ? 0.5 : 0);
  if (is_sheared) mesh.rest_positions.row(1) *= std::sqrt(0.75);
  if (pattern == Triangulation::jittered) {
    Random random(7);
    for (double& coordinate : mesh.rest_positions.topRows<2>().reshaped())
      coordinate += random.uniform(-kJitter, kJitter);
    while (flip_one(mesh)) {
    }
  }
  mesh.rest_positions *= edge;
  mesh.warp_directions.assign(mesh.triangles.size(), Vec3::UnitX());
  return mesh;
}

Positions on_cylinder(const Positions& flat, double angle, double radius) {
  const Vec3 along(std::cos(angle), std::sin(angle), 0);
  const Vec3 axis(-along.y(), along.x(), 0);
  Positions x(3, flat.cols());
  for (Eigen::Index i = 0; i < flat.cols(); ++i) {
    const double turn = along.dot(flat.col(i)) / radius;
    x.col(i) = radius * std::sin(turn) * along + axis.dot(flat.col(i)) * axis +
               radius * (1 - std::cos(turn)) * Vec3::UnitZ();
  }
  return x;
}

std::vector<CornerTexture> pattern_of(const TriangleMesh& mesh) {
  std::vector<CornerTexture> pattern;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    pattern.push_back(flat_corners(mesh, FaceId(static_cast<std::int64_t>(f))));
  return pattern;
}

}  // namespace pleat
