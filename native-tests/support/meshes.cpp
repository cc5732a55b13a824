#include "native-tests/support/meshes.h"

#include <cmath>
#include <vector>

namespace pleat {
namespace {

/// Vertices of a polyline of `n` edges of length `edge` that turns by `turn` at each vertex.
std::vector<Eigen::Vector2d> turning_line(int n, double edge, double turn) {
  std::vector<Eigen::Vector2d> line{Eigen::Vector2d::Zero()};
  for (int i = 0; i < n; ++i)
    line.push_back(line.back() + edge * Eigen::Vector2d(std::cos(i * turn), std::sin(i * turn)));
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

}  // namespace

QuadMesh square_sheet(int cells) {
  SheetShape shape;
  shape.rows = cells;
  shape.columns = cells;
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

}  // namespace pleat
