#include "core/hierarchy/edge_collapse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "core/base/check.h"
#include "core/mesh/mesh_fault.h"

namespace pleat {
namespace {

/// Share of a plane's weight: small enough that any bend outweighs an uneven spread.
constexpr double kPointShare = 1e-3;

/// Costs and lengths that differ by less than this share of their usual size are equal: on a
/// regular mesh rounding would decide otherwise.
constexpr double kEqual = 1e-6;

/// Twice the area, along the normal.
Vec3 area_vector(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
  return (x1 - x0).cross(x2 - x0);
}

bool has(const Triangle& triangle, VertexId v) {
  return triangle[0] == v || triangle[1] == v || triangle[2] == v;
}

/// True when the triangles around a vertex make one fan, closed or between two border edges.
bool is_one_fan(const std::vector<Triangle>& around, VertexId centre) {
  std::vector<std::array<VertexId, 2>> sides;  // opposite of the centre, as wound
  for (const Triangle& t : around) {
    const std::size_t k = t[0] == centre ? 0 : t[1] == centre ? 1 : 2;
    sides.push_back({t[(k + 1) % 3], t[(k + 2) % 3]});
  }
  auto at = sides.begin();  // first triangle of an open fan
  for (auto it = sides.begin(); it != sides.end(); ++it)
    if (std::none_of(sides.begin(), sides.end(), [&](auto& s) { return s[1] == (*it)[0]; }))
      at = it;
  std::size_t n_walked = 1;
  const VertexId first = (*at)[0];
  for (VertexId end = (*at)[1]; end != first; ++n_walked) {
    const auto next =
        std::find_if(sides.begin(), sides.end(), [&](auto& s) { return s[0] == end; });
    if (next == sides.end()) break;
    end = (*next)[1];
  }
  return n_walked == sides.size();
}

double rounded(double value, double unit) { return std::round(value / unit); }

}  // namespace

bool EdgeCollapse::Candidate::operator>(const Candidate& other) const {
  return std::tuple(cost, length, from.value, to.value) >
         std::tuple(other.cost, other.length, other.from.value, other.to.value);
}

EdgeCollapse::EdgeCollapse(const TriangleMesh& mesh, const std::vector<bool>& is_fixed,
                           CollapseGuards guards)
    : guards_(guards),
      triangles_(mesh.triangles),
      is_gone_(mesh.triangles.size(), false),
      is_kept_(is_fixed) {
  const auto n = static_cast<std::size_t>(mesh.n_vertices());
  PLEAT_CHECK(is_fixed.empty() || is_fixed.size() == n, "one flag for each vertex");
  PLEAT_CHECK(!mesh_fault(mesh.rest_positions, mesh.triangles, 0), "the mesh is sound");
  is_kept_.resize(n, false);
  is_border_.resize(n, false);
  triangles_of_.resize(n);
  quadrics_.resize(n);
  versions_.resize(n, 0);
  refused_.resize(n);
  mark_.resize(n, 0);
  n_vertices_ = mesh.n_vertices();
  if (n == 0) return;

  // Quadrics of places far from the origin would lose the digits that tell costs apart.
  const Vec3 low = mesh.rest_positions.rowwise().minCoeff();
  const Vec3 high = mesh.rest_positions.rowwise().maxCoeff();
  positions_ = mesh.rest_positions.colwise() - (low + high) / 2;
  for (std::size_t f = 0; f < triangles_.size(); ++f)
    for (const VertexId v : triangles_[f]) triangles_of_[v].push_back(static_cast<std::int32_t>(f));

  add_planes(mesh);
  keep_corners(mesh);
  for (std::size_t v = 0; v < n; ++v)
    for (const VertexId to : neighbours(VertexId(static_cast<std::int64_t>(v))))
      offer(VertexId(static_cast<std::int64_t>(v)), to);
}

void EdgeCollapse::add_planes(const TriangleMesh& mesh) {
  std::vector<Vec3> normals;
  double area = 0;
  for (const auto& [v0, v1, v2] : triangles_) {
    const Vec3 twice = area_vector(positions_.col(v0), positions_.col(v1), positions_.col(v2));
    normals.push_back(twice.normalized());
    area += twice.norm() / 2;
    const Quadric plane = Quadric::of_plane(positions_.col(v0), normals.back(), twice.norm() / 2);
    for (const VertexId v : {v0, v1, v2}) quadrics_[v] += plane;
  }
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    if (!edge.is_border()) continue;
    const Vec3 along = positions_.col(edge.b) - positions_.col(edge.a);
    const Vec3 upright = along.cross(normals[edge.faces[0]]).normalized();
    const Quadric plane = Quadric::of_plane(positions_.col(edge.a), upright, along.squaredNorm());
    for (const VertexId v : {edge.a, edge.b}) {
      if (guards_.borders) quadrics_[v] += plane;
      is_border_[v] = true;
    }
  }
  mean_area_ = area / n_vertices_;
  for (Eigen::Index v = 0; v < positions_.cols(); ++v)
    quadrics_[static_cast<std::size_t>(v)] +=
        Quadric::of_point(positions_.col(v), kPointShare * mean_area_);
}

void EdgeCollapse::keep_corners(const TriangleMesh& mesh) {
  constexpr double kCosineOfCorner = 0.7071;
  std::vector<Vec3> into(is_kept_.size()), out_of(is_kept_.size());
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    if (!edge.is_border()) continue;
    const Vec3 along = (positions_.col(edge.b) - positions_.col(edge.a)).normalized();
    out_of[edge.a] = along;
    into[edge.b] = along;
  }
  std::vector<Triangle> around;
  for (std::size_t v = 0; v < is_kept_.size(); ++v) {
    around.clear();
    for (const std::int32_t f : triangles_of_[v]) around.push_back(triangles_[f]);
    const bool is_corner =
        guards_.borders && is_border_[v] && into[v].dot(out_of[v]) < kCosineOfCorner;
    if (is_corner || !is_one_fan(around, VertexId(static_cast<std::int64_t>(v))))
      is_kept_[v] = true;
  }
}

std::vector<VertexId> EdgeCollapse::neighbours(VertexId vertex) const {
  std::vector<VertexId> found;
  for (const std::int32_t f : triangles_of_[vertex])
    for (const VertexId v : triangles_[f])
      if (v != vertex && std::find(found.begin(), found.end(), v) == found.end())
        found.push_back(v);
  return found;
}

void EdgeCollapse::offer(VertexId from, VertexId to) {
  if (is_kept_[from]) return;
  Quadric both = quadrics_[from];
  both += quadrics_[to];
  const Vec3 place = positions_.col(to);
  const double length = (place - positions_.col(from)).norm();
  candidates_.push({rounded(both.at(place), kEqual * kPointShare * mean_area_ * mean_area_),
                    rounded(length, kEqual * std::sqrt(mean_area_)), from, to, versions_[from],
                    versions_[to]});
}

void EdgeCollapse::offer_around(VertexId vertex) {
  refused_[vertex].clear();
  for (const VertexId other : neighbours(vertex)) {
    offer(vertex, other);
    offer(other, vertex);
    // A refused collapse may be sound now, since the triangles there have changed.
    std::vector<VertexId> again;
    again.swap(refused_[other]);
    for (const VertexId to : again)
      if (to != vertex && versions_[to] >= 0) offer(other, to);
  }
}

std::size_t EdgeCollapse::n_shared_triangles(VertexId from, VertexId to) const {
  const Numbers& around = triangles_of_[from];
  return static_cast<std::size_t>(std::count_if(
      around.begin(), around.end(), [&](std::int32_t f) { return has(triangles_[f], to); }));
}

bool EdgeCollapse::keeps_triangles(VertexId from, VertexId to) const {
  for (const std::int32_t f : triangles_of_[from]) {
    if (!has(triangles_[f], to)) continue;
    for (const VertexId v : triangles_[f])  // the third corner keeps a triangle
      if (v != from && v != to && triangles_of_[v].size() == 1) return false;
  }
  return triangles_of_[from].size() + triangles_of_[to].size() != 2 * n_shared_triangles(from, to);
}

bool EdgeCollapse::keeps_links(VertexId from, VertexId to) {
  const std::size_t n_shared = n_shared_triangles(from, to);
  if (is_border_[from] && is_border_[to] && n_shared != 1) return false;

  ++mark_now_;
  for (const VertexId v : neighbours(to)) mark_[v] = mark_now_;
  const std::vector<VertexId> ring = neighbours(from);
  const auto n_common =
      std::count_if(ring.begin(), ring.end(), [&](VertexId v) { return mark_[v] == mark_now_; });
  if (static_cast<std::size_t>(n_common) != n_shared) return false;
  // No triangle of `from` may land on one of `to`.
  for (const std::int32_t f : triangles_of_[from]) {
    if (has(triangles_[f], to)) continue;
    for (const std::int32_t g : triangles_of_[to]) {
      const auto is_common = [&](VertexId v) { return v == from || has(triangles_[g], v); };
      if (std::all_of(triangles_[f].begin(), triangles_[f].end(), is_common)) return false;
    }
  }
  return true;
}

bool EdgeCollapse::keeps_shapes(VertexId from, VertexId to) const {
  constexpr double kSlimmest = 1e-3;  // height over longest side; slimmer ones have no direction
  for (const std::int32_t f : triangles_of_[from]) {
    if (has(triangles_[f], to)) continue;
    std::array<Vec3, 3> before, after;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = triangles_[f][k];
      before[k] = positions_.col(v);
      after[k] = positions_.col(v == from ? to : v);
    }
    const Vec3 moved = area_vector(after[0], after[1], after[2]);
    if (moved.dot(area_vector(before[0], before[1], before[2])) < 0) return false;
    const double longest =
        std::max({(after[1] - after[0]).squaredNorm(), (after[2] - after[1]).squaredNorm(),
                  (after[0] - after[2]).squaredNorm()});
    if (moved.norm() < kSlimmest * longest) return false;
  }
  return true;
}

bool EdgeCollapse::is_allowed(VertexId from, VertexId to) {
  return keeps_triangles(from, to) && (!guards_.borders || keeps_border(from, to)) &&
         (!guards_.links || keeps_links(from, to)) && (!guards_.flips || keeps_shapes(from, to));
}

void EdgeCollapse::collapse(VertexId from, VertexId to) {
  for (const std::int32_t f : triangles_of_[from]) {
    if (!has(triangles_[f], to)) {
      std::replace(triangles_[f].begin(), triangles_[f].end(), from, to);
      triangles_of_[to].push_back(f);
      continue;
    }
    is_gone_[f] = true;
    for (const VertexId v : triangles_[f]) {
      if (v == from) continue;
      Numbers& own = triangles_of_[v];
      own.erase(std::find(own.begin(), own.end(), f));
    }
  }
  triangles_of_[from].clear();
  refused_[from].clear();
  quadrics_[to] += quadrics_[from];
  if (is_border_[from]) is_border_[to] = true;  // pulled inwards
  versions_[from] = -1;
  ++versions_[to];
  --n_vertices_;
  offer_around(to);
}

bool EdgeCollapse::reach(int n_vertices) {
  while (n_vertices_ > n_vertices && !candidates_.empty()) {
    const Candidate best = candidates_.top();
    candidates_.pop();
    if (versions_[best.from] != best.from_version || versions_[best.to] != best.to_version)
      continue;
    if (is_allowed(best.from, best.to))
      collapse(best.from, best.to);
    else
      refused_[best.from].push_back(best.to);
  }
  return n_vertices_ <= n_vertices;
}

std::vector<VertexId> EdgeCollapse::vertices() const {
  std::vector<VertexId> left;
  for (std::size_t v = 0; v < versions_.size(); ++v)
    if (versions_[v] >= 0) left.emplace_back(static_cast<std::int64_t>(v));
  return left;
}

std::vector<Triangle> EdgeCollapse::triangles() const {
  std::vector<Triangle> left;
  for (std::size_t f = 0; f < triangles_.size(); ++f)
    if (!is_gone_[f]) left.push_back(triangles_[f]);
  return left;
}

}  // namespace pleat
