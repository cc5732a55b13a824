#include "core/multigrid/surface_distances.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/base/check.h"
#include "core/mesh/edge_key.h"

namespace pleat {
namespace {

using Vec2 = Eigen::Vector2d;

/// Sine of an angle below which two rays are one.
constexpr double kSameRay = 1e-12;

std::int32_t next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }

double cross_product(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Third corner of a triangle on `base` with the distances a and b from its ends, to the right of
/// it. Seams may have sides that are too short by a little: then it is on the base.
Vec2 third_corner(const Vec2& begin, const Vec2& end, double a, double b) {
  const double base = (end - begin).norm();
  const double along = (a * a - b * b + base * base) / (2 * base);
  const double height = std::sqrt(std::max(0.0, a * a - along * along));
  const Vec2 unit = (end - begin) / base;
  return begin + along * unit + height * Vec2(unit.y(), -unit.x());
}

/// From the origin to a segment.
double distance_to(const Vec2& begin, const Vec2& end) {
  const Vec2 side = end - begin;
  const double share = std::clamp(-begin.dot(side) / side.squaredNorm(), 0.0, 1.0);
  return (begin + share * side).norm();
}

}  // namespace

SurfaceDistances::SurfaceDistances(const TriangleMesh& mesh)
    : edges_(3 * mesh.triangles.size()),
      from_(static_cast<std::size_t>(mesh.n_vertices())),
      distance_(static_cast<std::size_t>(mesh.n_vertices()), -1) {
  std::unordered_map<std::uint64_t, std::int32_t> by_ends;
  by_ends.reserve(edges_.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId from = mesh.triangles[f][k], to = mesh.triangles[f][(k + 1) % 3];
      const auto h = static_cast<std::int32_t>(3 * f + k);
      edges_[3 * f + k].from = from;
      from_[from].push_back(h);
      by_ends.emplace(directed_edge_key(from, to), h);
    }
  for (const MeshEdge& e : mesh_edges(mesh.triangles)) {
    const double length = rest_length(mesh, e);
    const auto there = by_ends.find(directed_edge_key(e.a, e.b));
    const auto back = by_ends.find(directed_edge_key(e.b, e.a));
    const std::int32_t h = there == by_ends.end() ? -1 : there->second;
    const std::int32_t twin = back == by_ends.end() ? -1 : back->second;
    if (h >= 0) edges_[static_cast<std::size_t>(h)] = {e.a, length, twin};
    if (twin >= 0) edges_[static_cast<std::size_t>(twin)] = {e.b, length, h};
  }
  find_turns();
}

void SurfaceDistances::find_turns() {
  constexpr double kPi = 3.14159265358979323846;
  constexpr double kRounding = 1e-9;  // [rad]
  std::vector<double> angle_sum(from_.size(), 0);
  std::vector<bool> is_border(from_.size(), false);
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const auto h = static_cast<std::int32_t>(i);
    const double a = edge(h).length, b = edge(next(next(h))).length, c = edge(next(h)).length;
    angle_sum[edge(h).from] +=
        std::acos(std::clamp((a * a + b * b - c * c) / (2 * a * b), -1.0, 1.0));
    if (edge(h).twin < 0) is_border[edge(h).from] = is_border[edge(next(h)).from] = true;
  }
  for (std::size_t v = 0; v < from_.size(); ++v)
    can_turn_.push_back(angle_sum[v] > (is_border[v] ? kPi : 2 * kPi) + kRounding);
}

void SurfaceDistances::reach(VertexId vertex, double distance) {
  double& known = distance_[vertex];
  if (known >= 0 && known <= distance) return;
  if (known < 0) touched_.push_back(vertex);
  known = distance;
  queue_.push({distance, vertex});
}

double SurfaceDistances::settle_along_edges(VertexId start, const std::vector<VertexId>& ends) {
  std::size_t n_open = ends.size();
  double last = 0;
  reach(start, 0);
  while (!queue_.empty() && n_open > 0) {
    const Reached nearest = queue_.top();
    queue_.pop();
    if (nearest.distance > distance_[nearest.vertex]) continue;
    last = nearest.distance;
    n_open -= static_cast<std::size_t>(std::count(ends.begin(), ends.end(), nearest.vertex));
    for (const std::int32_t h : from_[nearest.vertex]) {
      reach(edge(next(h)).from, nearest.distance + edge(h).length);
      const std::int32_t in = next(next(h));
      reach(edge(in).from, nearest.distance + edge(in).length);
    }
  }
  PLEAT_CHECK(n_open == 0, "the ends are in the part of the start");
  return last;
}

void SurfaceDistances::go_straight(VertexId start, double limit) {
  const double begin = distance_[start];
  for (const std::int32_t h : from_[start]) {
    const std::int32_t opposite = next(h);
    const double a = edge(h).length, b = edge(next(opposite)).length;
    reach(edge(opposite).from, begin + a);
    reach(edge(next(opposite)).from, begin + b);
    // Mirrored, the corner is to the left of the ray.
    const Vec2 right(a, 0);
    Vec2 left = third_corner(Vec2::Zero(), right, b, edge(opposite).length);
    left.y() = -left.y();
    windows_.push_back({opposite, right, left, right / a, left / b});
  }
  while (!windows_.empty()) {
    const Window window = windows_.back();
    windows_.pop_back();
    if (begin + distance_to(window.right, window.left) <= limit) cross(window, begin, limit);
  }
}

void SurfaceDistances::cross(const Window& window, double begin, double limit) {
  const std::int32_t twin = edge(window.half_edge).twin;
  if (twin < 0) return;
  const std::int32_t right_side = next(twin), left_side = next(right_side);
  const Vec2 corner =
      third_corner(window.right, window.left, edge(right_side).length, edge(left_side).length);
  const double distance = corner.norm();
  const Vec2 ray = corner / distance;
  const double from_right = cross_product(window.from, ray);
  const double from_left = cross_product(ray, window.to);
  if (from_right >= -kSameRay && from_left >= -kSameRay && begin + distance <= limit)
    reach(edge(left_side).from, begin + distance);
  if (from_right > kSameRay)
    windows_.push_back(
        {right_side, window.right, corner, window.from, from_left > 0 ? ray : window.to});
  if (from_left > kSameRay)
    windows_.push_back(
        {left_side, corner, window.left, from_right > 0 ? ray : window.from, window.to});
}

std::vector<double> SurfaceDistances::to(VertexId start, const std::vector<VertexId>& ends) {
  const double limit = settle_along_edges(start, ends);
  queue_ = {};
  for (const VertexId v : touched_)
    if (v == start || can_turn_[v]) queue_.push({distance_[v], v});
  while (!queue_.empty()) {
    const Reached nearest = queue_.top();
    queue_.pop();
    if (nearest.distance > limit) break;
    if (nearest.distance > distance_[nearest.vertex]) continue;
    if (nearest.vertex == start || can_turn_[nearest.vertex]) go_straight(nearest.vertex, limit);
  }
  std::vector<double> found;
  found.reserve(ends.size());
  for (const VertexId v : ends) found.push_back(distance_[v]);
  for (const VertexId v : touched_) distance_[v] = -1;
  touched_.clear();
  queue_ = {};
  return found;
}

}  // namespace pleat
