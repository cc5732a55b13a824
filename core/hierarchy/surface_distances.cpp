#include "core/hierarchy/surface_distances.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/check.h"

namespace pleat {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr double kHalfTurn = 3.14159265358979323846;  // [rad]

/// Angles that differ by less are the same [rad].
constexpr double kSameAngle = 1e-9;

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kAnyAngle = kNever;

/// Radius of the first search over the farthest end's distance in space, and its growth when an end
/// is not found.
constexpr double kLikely = 1.03;
constexpr double kFurther = 1.3;

/// Sine of an angle below which two rays are one.
constexpr double kSameRay = 1e-12;

std::int32_t next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }

double cross_product(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The third corner of a triangle on the side from `begin` to `end`, to the left of it.
Vec2 third_corner(const Vec2& begin, const Vec2& end, const Vec2& third) {
  const Vec2 side = end - begin;
  return begin + third.x() * side + third.y() * Vec2(-side.y(), side.x());
}

/// Squared distance from the origin to a segment.
double squared_distance_to(const Vec2& begin, const Vec2& end) {
  const Vec2 side = end - begin;
  const double share = std::clamp(-begin.dot(side) / side.squaredNorm(), 0.0, 1.0);
  return (begin + share * side).squaredNorm();
}

Vec2 ray_at(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

SurfaceDistances::SurfaceDistances(const TriangleMesh& mesh)
    : places_(mesh.rest_positions),
      edges_(3 * mesh.triangles.size()),
      from_(static_cast<std::size_t>(mesh.n_vertices())),
      free_angle_(static_cast<std::size_t>(mesh.n_vertices()), 0),
      arrivals_(static_cast<std::size_t>(mesh.n_vertices())) {
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId from = mesh.triangles[f][k];
      edges_[3 * f + k].from = from;
      from_[from].push_back(static_cast<std::int32_t>(3 * f + k));
    }
  // In a face, from one vertex to the other.
  const auto half_edge = [&](FaceId face, VertexId from) {
    std::int32_t h = 3 * face.value;
    while (edge(h).from != from) ++h;
    return h;
  };
  for (const MeshEdge& e : mesh_edges(mesh.triangles)) {
    const double length = rest_length(mesh, e);
    length_of_all_ += length;
    const std::int32_t h = half_edge(e.faces[0], e.a);
    const std::int32_t twin = e.is_border() ? -1 : half_edge(e.faces[1], e.b);
    for (const auto& [own, other] : {std::pair(h, twin), std::pair(twin, h)}) {
      if (own < 0) continue;
      edges_[static_cast<std::size_t>(own)].length = length;
      edges_[static_cast<std::size_t>(own)].twin = other;
    }
  }
  find_shapes();
  for (std::size_t v = 0; v < from_.size(); ++v) find_turns(VertexId(static_cast<std::int64_t>(v)));
}

// Seams may have sides that are too short by a little: then the third corner is on the base.
void SurfaceDistances::find_shapes() {
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const auto h = static_cast<std::int32_t>(i);
    const double base = edge(h).length, a = edge(next(next(h))).length, b = edge(next(h)).length;
    const double along = (a * a - b * b + base * base) / (2 * base);
    const double height = std::sqrt(std::max(0.0, a * a - along * along));
    edges_[i].third = Vec2(along, height) / base;
    edges_[i].corner = std::atan2(height, along);
  }
}

/// Lays out the angles around a vertex.
void SurfaceDistances::find_turns(VertexId vertex) {
  std::int32_t first = -1;
  for (const std::int32_t h : from_[vertex])
    if (first < 0 || edge(h).twin < 0) first = h;
  double sum = 0;
  std::size_t n_walked = 0;
  std::int32_t h = first;
  while (h >= 0 && (h != first || n_walked == 0)) {
    edges_[static_cast<std::size_t>(h)].angle = sum;
    sum += edge(h).corner;
    ++n_walked;
    h = edge(next(next(h))).twin;
  }
  const bool is_border = h < 0;
  double free = sum - (is_border ? 1 : 2) * kHalfTurn;
  // A path along a straight border goes on, however rounding bends it.
  if (is_border && std::abs(free) <= kSameAngle) free = 2 * kSameAngle;
  // Where several fans of triangles meet, a path goes from one to another.
  free_angle_[vertex] = n_walked < from_[vertex].size() ? kAnyAngle : free;
}

bool SurfaceDistances::can_turn(VertexId vertex) const { return free_angle_[vertex] > kSameAngle; }

SurfaceDistances::Reached SurfaceDistances::pop() {
  std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
  const Reached nearest = queue_.back();
  queue_.pop_back();
  return nearest;
}

void SurfaceDistances::push(VertexId vertex) {
  queue_.push_back({arrivals_[vertex].distance, vertex});
  std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
}

void SurfaceDistances::reach(VertexId vertex, const Arrival& arrival) {
  Arrival& known = arrivals_[vertex];
  if (known.distance <= arrival.distance) return;
  if (known.distance == kNever) touched_.push_back(vertex);
  known = arrival;
  if (can_turn(vertex)) push(vertex);
}

void SurfaceDistances::go_along_edges(VertexId vertex) {
  const double start_distance = arrivals_[vertex].distance;
  for (const std::int32_t out : from_[vertex]) {
    const HalfEdge& beyond = edge(next(out));
    const HalfEdge& in = edge(next(next(out)));
    reach(beyond.from, {start_distance + edge(out).length, beyond.angle + beyond.corner});
    if (in.twin < 0) reach(in.from, {start_distance + in.length, in.angle});
  }
}

/// Adds the window from the corner of a triangle through the part of its far side that is seen
/// between two angles around the corner.
void SurfaceDistances::look_through(std::int32_t half_edge, double from_angle, double to_angle) {
  const HalfEdge& out = edge(half_edge);
  const double from = std::max(from_angle - out.angle, 0.0);
  const double to = std::min(to_angle - out.angle, out.corner);
  if (!(from < to)) return;
  const Vec2 right(out.length, 0);
  const Vec2 left = third_corner(Vec2::Zero(), right, out.third);
  windows_.push_back({next(half_edge), right, left, from > 0 ? ray_at(from) : Vec2::UnitX(),
                      to < out.corner ? ray_at(to) : left.normalized()});
}

/// Straight on from the start, into all directions, or from a vertex where paths turn into those
/// that are half a turn or more from where the path comes in, on either side.
void SurfaceDistances::go_on_from(VertexId vertex, double limit) {
  go_along_edges(vertex);
  const Arrival arrival = arrivals_[vertex];
  const double free = free_angle_[vertex];
  const double near = kHalfTurn - kSameAngle, far = kHalfTurn + free + kSameAngle;
  for (const std::int32_t h : from_[vertex]) {
    if (arrival.distance == 0 || free == kAnyAngle) {
      look_through(h, 0, kAnyAngle);
    } else {
      look_through(h, arrival.angle + near, arrival.angle + far);
      look_through(h, arrival.angle - far, arrival.angle - near);
    }
  }
  const double rest = limit - arrival.distance;
  while (!windows_.empty()) {
    const Window window = windows_.back();
    windows_.pop_back();
    if (squared_distance_to(window.right, window.left) <= rest * rest)
      cross(window, arrival.distance, limit);
  }
}

void SurfaceDistances::cross(const Window& window, double start_distance, double limit) {
  const std::int32_t twin = edge(window.half_edge).twin;
  if (twin < 0) return;
  const std::int32_t right_side = next(twin), left_side = next(right_side);
  const Vec2 corner = third_corner(window.left, window.right, edge(twin).third);
  const double distance = corner.norm();
  const Vec2 ray = corner / distance;
  const double from_right = cross_product(window.from, ray);
  const double from_left = cross_product(ray, window.to);
  if (from_right >= -kSameRay && from_left >= -kSameRay && start_distance + distance <= limit) {
    const HalfEdge& out = edge(left_side);
    const Vec2 side = window.left - corner;
    double angle = 0;
    if (start_distance + distance < arrivals_[out.from].distance && can_turn(out.from))
      angle = std::atan2(cross_product(side, -corner), side.dot(-corner));
    reach(out.from, {start_distance + distance, out.angle + angle});
  }
  if (from_right > kSameRay)
    windows_.push_back(
        {right_side, window.right, corner, window.from, from_left > 0 ? ray : window.to});
  if (from_left > kSameRay)
    windows_.push_back(
        {left_side, corner, window.left, from_right > 0 ? ray : window.from, window.to});
}

double SurfaceDistances::farthest(const std::vector<VertexId>& ends) const {
  double farthest = 0;
  for (const VertexId v : ends) farthest = std::max(farthest, arrivals_[v].distance);
  return farthest;
}

/// False where an end is further than the limit.
bool SurfaceDistances::search(VertexId start, const std::vector<VertexId>& ends, double limit) {
  for (const VertexId v : touched_) arrivals_[v] = {};
  touched_.clear();
  reach(start, {0, 0});
  queue_.clear();
  go_on_from(start, limit);
  while (!queue_.empty()) {
    const auto [distance, vertex] = pop();
    const double rest = std::min(limit, farthest(ends));
    if (distance > rest) break;
    if (distance <= arrivals_[vertex].distance) go_on_from(vertex, rest);
  }
  return farthest(ends) <= limit;
}

std::vector<double> SurfaceDistances::to(VertexId start, const std::vector<VertexId>& ends) {
  double limit = edge(from_[start].front()).length;
  for (const VertexId v : ends)
    limit = std::max(limit, kLikely * (places_.col(v) - places_.col(start)).norm());
  for (; !search(start, ends, limit); limit *= kFurther)
    PLEAT_CHECK(limit < length_of_all_, "the ends are in the part of the start");
  std::vector<double> found;
  found.reserve(ends.size());
  for (const VertexId v : ends) found.push_back(arrivals_[v].distance);
  return found;
}

}  // namespace pleat
