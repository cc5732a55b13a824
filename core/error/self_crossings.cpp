#include "core/error/self_crossings.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "core/base/check.h"
#include "core/mesh/edge_key.h"

namespace pleat {
namespace {

/// How far vertices may be from where they were meant, in shares of the cloth's largest coordinate:
/// some roundings.
constexpr double kVertexRounding = 1e-15;

/// Six times the volume of a tetrahedron, as its sign: 0 where rounding could have made it.
///
/// The volume's own bound is (7 + 56 u) u, u = 2^-53, of the sum of the products' sizes: Shewchuk,
/// Adaptive precision floating-point arithmetic and fast robust geometric predicates, Discrete &
/// Computational Geometry 18(3), 1997. Vertices that move by `slack` [m] change it by that times
/// the faces' doubled areas, of which the fourth is at most the sum of the others.
int volume_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double slack) {
  constexpr double kRounding = 7.8e-16;
  const Vec3 p = a - d;
  const Vec3 q = b - d;
  const Vec3 r = c - d;
  const Vec3 across = q.cross(r);
  const double volume = p.dot(across);
  double size = 0;
  for (int k = 0; k < 3; ++k)
    size += std::abs(p[k]) *
            (std::abs(q[(k + 1) % 3] * r[(k + 2) % 3]) + std::abs(q[(k + 2) % 3] * r[(k + 1) % 3]));
  const double areas = across.norm() + r.cross(p).norm() + p.cross(q).norm();
  const double bound = kRounding * size + 2 * slack * areas;
  return std::abs(volume) <= bound ? 0 : volume > 0 ? 1 : -1;
}

/// Its ends lie on either side of the plane, and its line passes all three borders on one side.
bool passes(const Vec3& from, const Vec3& to, const Corners& c, double slack) {
  const int begin = volume_sign(c[0], c[1], c[2], from, slack);
  if (begin == 0 || volume_sign(c[0], c[1], c[2], to, slack) != -begin) return false;
  const int side = volume_sign(from, to, c[0], c[1], slack);
  return side != 0 && volume_sign(from, to, c[1], c[2], slack) == side &&
         volume_sign(from, to, c[2], c[0], slack) == side;
}

}  // namespace

SelfCrossings::SelfCrossings(const std::vector<Triangle>& triangles, const PositionsView& positions,
                             std::span<const HangingVertex> hanging)
    : positions_(positions), parents_(static_cast<std::size_t>(positions.cols())) {
  std::unordered_set<std::uint64_t> known;  // only looked up, never walked
  for (const HangingVertex& h : hanging) {
    parents_[h.vertex] = h.parents;
    known.insert(edge_key(h.parents[0], h.parents[1]));
  }
  if (triangles.empty()) return;
  corners_.resize(triangles.size());
  boxes_.emplace(triangle_corners(triangles, positions));
  for (const std::size_t t : boxes_->order()) {
    const Triangle& c = triangles[t];
    members_.push_back({c, {}, {}});
    for (std::size_t k = 0; k < 3; ++k)
      members_.back().owns[k] = known.insert(edge_key(c[k], c[(k + 1) % 3])).second;
  }
}

std::int64_t SelfCrossings::count(const PositionsView& positions) {
  PLEAT_CHECK(positions.cols() == positions_.cols() && positions.allFinite(),
              "a finite place for every vertex");
  if (!boxes_) return 0;
  positions_ = positions;
  slack_ = kVertexRounding * positions.cwiseAbs().maxCoeff();
  for (std::size_t m = 0; m < members_.size(); ++m) {
    Member& member = members_[m];
    for (std::size_t k = 0; k < 3; ++k) corners_[m][k] = positions_.col(member.corners[k]);
    member.box.setEmpty();
    for (const Vec3& corner : corners_[m]) member.box.extend(corner);
  }
  boxes_->fit(corners_);
  return within(0);
}

bool SelfCrossings::are_neighbours(VertexId v, const Triangle& triangle) const {
  const auto is_parent = [this](VertexId parent, VertexId child) {
    return parents_[child][0] == parent || parents_[child][1] == parent;
  };
  return std::any_of(triangle.begin(), triangle.end(), [&](VertexId corner) {
    return corner == v || is_parent(corner, v) || is_parent(v, corner);
  });
}

bool SelfCrossings::crosses(const Member& edges, int edge, const Member& triangle) const {
  const VertexId a = edges.corners[edge];
  const VertexId b = edges.corners[(edge + 1) % 3];
  const Triangle& c = triangle.corners;
  return !are_neighbours(a, c) && !are_neighbours(b, c) &&
         passes(positions_.col(a), positions_.col(b),
                {positions_.col(c[0]), positions_.col(c[1]), positions_.col(c[2])}, slack_);
}

std::int64_t SelfCrossings::between(const Member& a, const Member& b) const {
  if (!a.box.intersects(b.box)) return 0;
  std::int64_t n = 0;
  for (int k = 0; k < 3; ++k)
    n += (a.owns[k] && crosses(a, k, b) ? 1 : 0) + (b.owns[k] && crosses(b, k, a) ? 1 : 0);
  return n;
}

std::int64_t SelfCrossings::within(std::size_t node) const {
  const TriangleBoxes::Node& at = boxes_->nodes()[node];
  if (!at.is_leaf()) return within(node + 1) + within(at.second) + between(node + 1, at.second);
  std::int64_t n = 0;
  for (std::size_t a = at.begin; a < at.end; ++a)
    for (std::size_t b = a + 1; b < at.end; ++b) n += between(members_[a], members_[b]);
  return n;
}

std::int64_t SelfCrossings::between(std::size_t node_a, std::size_t node_b) const {
  const TriangleBoxes::Node& a = boxes_->nodes()[node_a];
  const TriangleBoxes::Node& b = boxes_->nodes()[node_b];
  if (!a.box.intersects(b.box)) return 0;
  if (!a.is_leaf() && (b.is_leaf() || a.end - a.begin >= b.end - b.begin))
    return between(node_a + 1, node_b) + between(a.second, node_b);
  if (!b.is_leaf()) return between(node_a, node_b + 1) + between(node_a, b.second);
  std::int64_t n = 0;
  for (std::size_t i = a.begin; i < a.end; ++i)
    for (std::size_t j = b.begin; j < b.end; ++j) n += between(members_[i], members_[j]);
  return n;
}

std::int64_t self_crossings(const std::vector<Triangle>& triangles, const PositionsView& positions,
                            std::span<const HangingVertex> hanging) {
  return SelfCrossings(triangles, positions, hanging).count(positions);
}

}  // namespace pleat
