#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/base/check.h"
#include "core/modal/carrying_volume.h"

namespace pleat {
namespace {

using Cell = std::array<int, 3>;

/// A cube counts as passed by what reaches farther into it than this share of its edge: a surface
/// that lies on a side of cubes needs those within it alone.
constexpr double kTouch = 1e-6;

/// Cubes in a box, which know what they are to the surface.
class Lattice {
 public:
  Lattice(const Positions& surface, double edge) : edge_(edge) {
    const Vec3 low = surface.rowwise().minCoeff();
    const Vec3 high = surface.rowwise().maxCoeff();
    double n_cells = 1;
    for (int k = 0; k < 3; ++k) {
      const double cells = std::max(1.0, std::ceil((high[k] - low[k]) / edge - kTouch));
      n_cells *= cells + 1;
      if (n_cells > static_cast<double>(kMaxVertices))
        throw InputError("", "expected a lattice of at most " + std::to_string(kMaxVertices) +
                                 " vertices, got more; take longer edges");
      n_[static_cast<std::size_t>(k)] = static_cast<int>(cells);
      origin_[k] = (low[k] + high[k] - cells * edge) / 2;
    }
    is_used_.resize(static_cast<std::size_t>(n_[0]) * n_[1] * n_[2], 0);
  }

  int n(int axis) const { return n_[static_cast<std::size_t>(axis)]; }
  double edge() const { return edge_; }
  Vec3 corner(const Cell& cell) const { return origin_ + edge_ * Vec3(cell[0], cell[1], cell[2]); }
  Vec3 centre(const Cell& cell) const { return corner(cell) + Vec3::Constant(edge_ / 2); }
  /// Coordinates in cells from the lattice's corner.
  Vec3 coordinates(const Vec3& place) const { return (place - origin_) / edge_; }

  bool is_used(const Cell& cell) const { return is_used_[index(cell)] != 0; }
  void use(const Cell& cell) { is_used_[index(cell)] = 1; }

  /// The cell along an axis that a coordinate lies in, within the lattice.
  int clamped(int axis, double coordinate) const {
    return std::clamp(static_cast<int>(std::floor(coordinate)), 0, n(axis) - 1);
  }

 private:
  std::size_t index(const Cell& cell) const {
    return (static_cast<std::size_t>(cell[2]) * n_[1] + cell[1]) * n_[0] + cell[0];
  }

  double edge_;
  Cell n_{};
  Vec3 origin_{0, 0, 0};
  std::vector<char> is_used_;
};

using Corners = std::array<Vec3, 3>;

/// True when a triangle and a box about the origin share more than a touch.
/// Source: Akenine-Moeller, Fast 3D triangle-box overlap testing, J. Graphics Tools 6, 2001.
bool overlap(const Corners& corners, double half) {
  const auto is_apart = [&](const Vec3& axis) {
    const double reach = half * axis.cwiseAbs().sum();
    const double p0 = axis.dot(corners[0]);
    const double p1 = axis.dot(corners[1]);
    const double p2 = axis.dot(corners[2]);
    return std::min({p0, p1, p2}) >= reach || std::max({p0, p1, p2}) <= -reach;
  };
  const std::array<Vec3, 3> edges = {corners[1] - corners[0], corners[2] - corners[1],
                                     corners[0] - corners[2]};
  for (int k = 0; k < 3; ++k) {
    if (is_apart(Vec3::Unit(k))) return false;
    for (const Vec3& edge : edges)
      if (const Vec3 axis = Vec3::Unit(k).cross(edge); axis.squaredNorm() > 0 && is_apart(axis))
        return false;
  }
  return !is_apart(edges[0].cross(edges[1]));
}

void use_passed_cells(Lattice& lattice, const Positions& surface,
                      const std::vector<Triangle>& triangles) {
  const double half = lattice.edge() * (0.5 - kTouch);
  for (const Triangle& triangle : triangles) {
    Cell from{};
    Cell to{};
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      const auto coordinate = [&](VertexId v) { return lattice.coordinates(surface.col(v))[k]; };
      const auto [low, high] =
          std::minmax({coordinate(triangle[0]), coordinate(triangle[1]), coordinate(triangle[2])});
      from[axis] = lattice.clamped(k, low - kTouch);
      to[axis] = lattice.clamped(k, high + kTouch);
    }
    Cell cell{};
    for (cell[2] = from[2]; cell[2] <= to[2]; ++cell[2])
      for (cell[1] = from[1]; cell[1] <= to[1]; ++cell[1])
        for (cell[0] = from[0]; cell[0] <= to[0]; ++cell[0]) {
          if (lattice.is_used(cell)) continue;
          const Vec3 centre = lattice.centre(cell);
          if (overlap({surface.col(triangle[0]) - centre, surface.col(triangle[1]) - centre,
                       surface.col(triangle[2]) - centre},
                      half))
            lattice.use(cell);
        }
  }
}

/// True when a place p in the plane of y and z is to the left of the line from a to b, and not to
/// that of the line from b to a. One on the line counts as moved by a little along z and by far
/// less along y: of triangles around a vertex just one then holds it. Source: Edelsbrunner &
/// Muecke, Simulation of simplicity, ACM Transactions on Graphics 9, 1990.
bool is_left(const Positions& surface, VertexId a, VertexId b, double y, double z) {
  const bool is_turned = b < a;
  const Vec3 from = surface.col(is_turned ? b : a);
  const Vec3 way = surface.col(is_turned ? a : b) - from;
  const double area = way.y() * (z - from.z()) - way.z() * (y - from.y());
  const bool left = area != 0 ? area > 0 : way.y() != 0 ? way.y() > 0 : way.z() < 0;
  return left != is_turned;
}

/// Crossing of the surface by a line along x through the centres of cells, from in front or behind.
struct Crossing {
  double x;
  int sign;
};

[[noreturn]] void throw_passes_through_itself(const Vec3& place) {
  std::string where;
  for (const double x : place) where += (where.empty() ? "" : ", ") + std::to_string(x);
  throw InputError(
      "", "expected a surface that does not pass through itself; it does near (" + where + ") m");
}

void use_inner_cells(Lattice& lattice, const Positions& surface,
                     const std::vector<Triangle>& triangles) {
  const auto column = [&](int j, int k) { return static_cast<std::size_t>(k) * lattice.n(1) + j; };
  std::vector<std::vector<Crossing>> crossings(column(0, lattice.n(2)));
  for (const auto& [a, b, c] : triangles) {
    const Vec3 low =
        lattice.coordinates(surface.col(a).cwiseMin(surface.col(b)).cwiseMin(surface.col(c)));
    const Vec3 high =
        lattice.coordinates(surface.col(a).cwiseMax(surface.col(b)).cwiseMax(surface.col(c)));
    const Vec3 normal = (surface.col(b) - surface.col(a)).cross(surface.col(c) - surface.col(a));
    for (int k = lattice.clamped(2, low.z()); k <= lattice.clamped(2, high.z()); ++k)
      for (int j = lattice.clamped(1, low.y()); j <= lattice.clamped(1, high.y()); ++j) {
        const Vec3 centre = lattice.centre({0, j, k});
        const auto left = [&](VertexId from, VertexId to) {
          return is_left(surface, from, to, centre.y(), centre.z());
        };
        const bool first = left(a, b);
        if (first != left(b, c) || first != left(c, a) || normal.x() == 0) continue;
        const Vec3 from_corner = centre - surface.col(a);
        const double x = surface.col(a).x() -
                         (normal.y() * from_corner.y() + normal.z() * from_corner.z()) / normal.x();
        crossings[column(j, k)].push_back({x, first ? 1 : -1});
      }
  }
  Cell cell{};
  int inside = 0;  // how often the surface goes round what is inside: once, one way or the other
  for (cell[2] = 0; cell[2] < lattice.n(2); ++cell[2])
    for (cell[1] = 0; cell[1] < lattice.n(1); ++cell[1])
      for (cell[0] = 0; cell[0] < lattice.n(0); ++cell[0]) {
        int winding = 0;
        for (const Crossing& crossing : crossings[column(cell[1], cell[2])])
          if (crossing.x > lattice.centre(cell).x()) winding += crossing.sign;
        if (winding == 0) continue;
        if (inside == 0) inside = winding > 0 ? 1 : -1;
        if (winding != inside) throw_passes_through_itself(lattice.centre(cell));
        lattice.use(cell);
      }
}

/// The axes from the largest of three shares to the smallest: the way from a cube's corner to its
/// opposite one that the tetrahedron around them goes.
std::array<int, 3> falling(const Vec3& shares) {
  std::array<int, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return shares[a] > shares[b]; });
  return axes;
}

/// Vertices of the volume by their places in the lattice, numbered as they are first asked for.
class Nodes {
 public:
  explicit Nodes(const Lattice& lattice) : lattice_(lattice) {}

  VertexId at(const Cell& place) {
    const auto [known, is_new] = ids_.try_emplace(place, VertexId(places_.size()));
    if (is_new) places_.push_back(lattice_.corner(place));
    return known->second;
  }
  Positions positions() const {
    Positions positions(3, static_cast<Eigen::Index>(places_.size()));
    for (std::size_t i = 0; i < places_.size(); ++i)
      positions.col(static_cast<Eigen::Index>(i)) = places_[i];
    return positions;
  }

 private:
  const Lattice& lattice_;
  std::map<Cell, VertexId> ids_;
  std::vector<Vec3> places_;
};

/// The corners that a way through a cube along these axes passes.
Tet corners_along(Nodes& nodes, Cell cell, const std::array<int, 3>& axes) {
  Tet tet;
  tet[0] = nodes.at(cell);
  for (std::size_t k = 0; k < 3; ++k) {
    ++cell[static_cast<std::size_t>(axes[k])];
    tet[k + 1] = nodes.at(cell);
  }
  return tet;
}

/// A used cell that holds the place, or touches it.
Cell cell_around(const Lattice& lattice, const Vec3& coordinates) {
  std::array<std::array<int, 2>, 3> candidates{};
  for (int k = 0; k < 3; ++k)
    candidates[static_cast<std::size_t>(k)] = {lattice.clamped(k, coordinates[k] - 2 * kTouch),
                                               lattice.clamped(k, coordinates[k] + 2 * kTouch)};
  for (const int z : candidates[2])
    for (const int y : candidates[1])
      for (const int x : candidates[0])
        if (lattice.is_used({x, y, z})) return {x, y, z};
  PLEAT_CHECK(false, "the lattice covers the surface");
}

SparseMatrix embedding(const Lattice& lattice, Nodes& nodes, const Positions& surface) {
  std::vector<Eigen::Triplet<double, int>> weights;
  for (int v = 0; v < surface.cols(); ++v) {
    const Vec3 coordinates = lattice.coordinates(surface.col(v));
    const Cell cell = cell_around(lattice, coordinates);
    const Vec3 shares = (coordinates - Vec3(cell[0], cell[1], cell[2])).cwiseMax(0.0).cwiseMin(1.0);
    const std::array<int, 3> axes = falling(shares);
    const Tet tet = corners_along(nodes, cell, axes);
    const std::array<double, 5> steps = {1, shares[axes[0]], shares[axes[1]], shares[axes[2]], 0};
    for (std::size_t k = 0; k < 4; ++k) weights.emplace_back(tet[k], v, steps[k] - steps[k + 1]);
  }
  SparseMatrix matrix(nodes.positions().cols(), surface.cols());
  matrix.setFromTriplets(weights.begin(), weights.end());
  return matrix;
}

void check_closed(const std::vector<Triangle>& triangles) {
  std::map<std::pair<int, int>, int> directed;
  for (const Triangle& triangle : triangles)
    for (std::size_t k = 0; k < 3; ++k) ++directed[{triangle[k], triangle[(k + 1) % 3]}];
  for (const auto& [ends, count] : directed) {
    const auto back = directed.find({ends.second, ends.first});
    const int n_back = back == directed.end() ? 0 : back->second;
    if (count == 1 && n_back == 1) continue;
    throw InputError("",
                     "expected a closed surface, each edge between two triangles that are "
                     "wound alike; the edge from vertex " +
                         std::to_string(ends.first) + " to " + std::to_string(ends.second) +
                         " has " + std::to_string(count) + " one way round and " +
                         std::to_string(n_back) + " the other");
  }
}

}  // namespace

CarryingVolume lattice_volume(const Positions& surface, const std::vector<Triangle>& triangles,
                              double edge) {
  PLEAT_CHECK(edge > 0, "cubes have positive edges");
  PLEAT_CHECK(surface.cols() > 0 && surface.allFinite(), "a surface has finite vertices");
  check_closed(triangles);
  Lattice lattice(surface, edge);
  use_passed_cells(lattice, surface, triangles);
  use_inner_cells(lattice, surface, triangles);

  CarryingVolume result;
  Nodes nodes(lattice);
  Cell cell{};
  for (cell[2] = 0; cell[2] < lattice.n(2); ++cell[2])
    for (cell[1] = 0; cell[1] < lattice.n(1); ++cell[1])
      for (cell[0] = 0; cell[0] < lattice.n(0); ++cell[0]) {
        if (!lattice.is_used(cell)) continue;
        std::array<int, 3> axes = {0, 1, 2};
        do {
          Tet tet = corners_along(nodes, cell, axes);
          const bool is_odd = (axes[1] - axes[0] + 3) % 3 == 2;
          if (is_odd) std::swap(tet[2], tet[3]);
          result.volume.tets.push_back(tet);
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
  result.volume.rest_positions = nodes.positions();
  result.embedding = embedding(lattice, nodes, surface);
  if (!hangs_together_by_faces(result.volume))
    throw InputError("", "expected a lattice whose parts hang together by faces; with edges of " +
                             std::to_string(edge) +
                             " m it touches itself along an edge only, take other ones");
  return result;
}

}  // namespace pleat
