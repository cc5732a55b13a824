#include "core/fabric/balanced_stencil.h"

#include <algorithm>
#include <utility>

namespace pleat {
namespace {

using Vec2 = Eigen::Vector2d;

/// A linear function of the values at some vertices. Few enough to search them one by one.
template <class Weight>
class Combination {
 public:
  void add(VertexId vertex, const Weight& weight) {
    for (auto& [known, sum] : terms_) {
      if (known != vertex) continue;
      sum += weight;
      return;
    }
    terms_.emplace_back(vertex, weight);
  }
  const std::vector<std::pair<VertexId, Weight>>& terms() const { return terms_; }

 private:
  std::vector<std::pair<VertexId, Weight>> terms_;
};

/// A triangle as one of its edges sees it. The edge's frame: t along it, n across it, out of the
/// first triangle and into the second, both in the plane of the triangle at hand.
struct EdgeSide {
  FaceId face;
  Vec2 t, n;    // unit vectors in thread directions
  Vec2 corner;  // opposite corner, from the middle of the edge [m]
};

EdgeSide edge_side(const TriangleMesh& mesh, const MeshEdge& edge, std::size_t side) {
  const FaceId face = edge.faces[side];
  const Triangle& corners = mesh.triangles[face];
  const CornerTexture flat = flat_corners(mesh, face);
  const auto place = [&](VertexId v) {
    return Vec2(flat.col(std::find(corners.begin(), corners.end(), v) - corners.begin()));
  };
  const Vec2 along = (place(edge.b) - place(edge.a)).normalized();
  const Vec2 arm = place(edge.across[side]) - (place(edge.a) + place(edge.b)) / 2;
  const Vec2 height = arm - arm.dot(along) * along;
  const double sign = side == 0 ? -1 : 1;  // the first triangle's corner lies against n
  return {face, along, sign * height.normalized(), {arm.dot(along), sign * height.norm()}};
}

/// p' H q of the second derivatives (ww, ff, wf).
double bilinear(const Vec3& H, const Vec2& p, const Vec2& q) {
  return p.x() * q.x() * H[0] + p.y() * q.y() * H[1] + (p.x() * q.y() + p.y() * q.x()) * H[2];
}

/// The fitted second derivatives at an edge (tt, tn, nn): the mean of those beside it.
Combination<Vec3> second_derivatives(const std::vector<EdgeSide>& sides,
                                     const std::vector<CurvatureStencil>& fits) {
  Combination<Vec3> result;
  for (const EdgeSide& side : sides) {
    const CurvatureStencil& fit = fits[side.face];
    for (std::size_t k = 0; k < fit.vertices.size(); ++k) {
      const Vec3 H = fit.weights.col(static_cast<Eigen::Index>(k));
      const Vec3 turned(bilinear(H, side.t, side.t), bilinear(H, side.t, side.n),
                        bilinear(H, side.n, side.n));
      result.add(fit.vertices[k], turned / static_cast<double>(sides.size()));
    }
  }
  return result;
}

/// The derivative along n at the middle of an edge. With g the gradient there, a quadratic has
///
///   w_c = w_m + g.c + c'H c/2  at a corner c,  w_m = (w_a + w_b)/2 - l^2 H_tt/8.
///
/// Inside, the difference of both corners is solved for g_n, at a border the first corner alone;
/// g_t is (w_b - w_a)/l.
Combination<double> slope_across(const MeshEdge& edge, const std::vector<EdgeSide>& sides,
                                 double length, const Combination<Vec3>& H) {
  Vec2 reach = sides[0].corner;  // factors of g
  Vec3 squares(reach.x() * reach.x(), 2 * reach.x() * reach.y(), reach.y() * reach.y());
  Combination<double> rise;  // value of g.reach + H.squares/2
  rise.add(edge.across[0], 1);
  if (edge.is_border()) {
    rise.add(edge.a, -0.5);
    rise.add(edge.b, -0.5);
    squares[0] -= length * length / 4;
  } else {
    const Vec2& c = sides[1].corner;
    reach -= c;
    squares -= Vec3(c.x() * c.x(), 2 * c.x() * c.y(), c.y() * c.y());
    rise.add(edge.across[1], -1);
  }
  rise.add(edge.a, reach.x() / length);
  rise.add(edge.b, -reach.x() / length);
  for (const auto& [vertex, weight] : H.terms()) rise.add(vertex, -0.5 * squares.dot(weight));
  Combination<double> slope;
  for (const auto& [vertex, weight] : rise.terms()) slope.add(vertex, weight / reach.y());
  return slope;
}

/// Length times n times the gradient g, its symmetric part in thread directions (ww, ff, wf).
Vec3 boundary_term(const EdgeSide& side, double length, const Vec2& g) {
  const Vec2 gradient = g.x() * side.t + g.y() * side.n;
  return length * Vec3(side.n.x() * gradient.x(), side.n.y() * gradient.y(),
                       (side.n.x() * gradient.y() + side.n.y() * gradient.x()) / 2);
}

/// Leaves out vertices whose terms cancelled but for rounding: they would only widen matrices.
CurvatureStencil without_noise(const Combination<Vec3>& sum, double area) {
  constexpr double kRounding = 1e-11;  // area times weight is of order 1 on any scale
  CurvatureStencil stencil;
  stencil.area = area;
  stencil.weights.resize(3, static_cast<Eigen::Index>(sum.terms().size()));
  for (const auto& [vertex, weight] : sum.terms()) {
    if (weight.norm() <= kRounding) continue;
    stencil.weights.col(static_cast<Eigen::Index>(stencil.vertices.size())) = weight / area;
    stencil.vertices.push_back(vertex);
  }
  stencil.weights.conservativeResize(3, static_cast<Eigen::Index>(stencil.vertices.size()));
  return stencil;
}

}  // namespace

std::vector<CurvatureStencil> balanced_stencils(const TriangleMesh& mesh) {
  const std::vector<CurvatureStencil> fits = curvature_stencils(mesh);
  std::vector<Combination<Vec3>> sums(fits.size());
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    std::vector<EdgeSide> sides{edge_side(mesh, edge, 0)};
    if (!edge.is_border()) sides.push_back(edge_side(mesh, edge, 1));
    const double length = rest_length(mesh, edge);
    const Combination<double> slope =
        slope_across(edge, sides, length, second_derivatives(sides, fits));
    for (std::size_t s = 0; s < sides.size(); ++s) {
      Combination<Vec3>& sum = sums[sides[s].face];
      const double outward = s == 0 ? 1 : -1;
      const Vec3 along = boundary_term(sides[s], outward, {1, 0});  // times l, over l
      sum.add(edge.a, -along);
      sum.add(edge.b, along);
      const Vec3 across = boundary_term(sides[s], outward * length, {0, 1});
      for (const auto& [vertex, weight] : slope.terms()) sum.add(vertex, weight * across);
    }
  }
  std::vector<CurvatureStencil> stencils;
  stencils.reserve(sums.size());
  for (std::size_t f = 0; f < sums.size(); ++f)
    stencils.push_back(without_noise(sums[f], fits[f].area));
  return stencils;
}

}  // namespace pleat
