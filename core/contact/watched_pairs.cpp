#include "core/contact/watched_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/contact/closest_points.h"

namespace pleat {
namespace {

/// Pairs are watched from this many thicknesses on: what responds does not depend on when the list
/// was made.
constexpr double kReach = 1.5;
/// Room of a vertex in shares of the least altitude around it: unfolded cloth lists no neighbours.
constexpr double kRoomOfWidth = 0.25;
/// Substeps that corridors are made for, at most.
constexpr double kMostSubsteps = 8;
/// Share of the room that counts: what rounding moves between substeps is far less.
constexpr double kSureRoom = 1 - 1e-6;

double least_altitude(const Positions& x, const Triangle& t) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, squared_distance(x, t[k].value, t[(k + 1) % 3].value));
  const Vec3 normal = (x.col(t[1]) - x.col(t[0])).cross(x.col(t[2]) - x.col(t[0]));
  return longest > 0 ? normal.norm() / std::sqrt(longest) : 0;
}

double largest_gap(const SelfContact& surfaces) {
  if (surfaces.is_loose) return surfaces.body_gap;
  return surfaces.bodies.empty() ? surfaces.thickness
                                 : std::max(surfaces.thickness, surfaces.body_gap);
}

NearPairs near_pairs(const SelfContact& surfaces, int n_vertices) {
  if (surfaces.bodies.empty()) return {surfaces.faces, surfaces.hanging, n_vertices};
  std::vector<Triangle> faces = surfaces.faces;
  std::vector<BoxGroup> groups(static_cast<std::size_t>(n_vertices),
                               surfaces.is_loose ? BoxGroup::loose_cloth : BoxGroup::cloth);
  for (const BodySurface& body : surfaces.bodies) {
    const auto first = static_cast<std::int32_t>(groups.size());
    for (const auto& [a, b, c] : body.triangles)
      faces.push_back({VertexId(first + a), VertexId(first + b), VertexId(first + c)});
    groups.resize(groups.size() + static_cast<std::size_t>(body.n_vertices()), BoxGroup::body);
  }
  return {std::move(faces), surfaces.hanging, std::move(groups)};
}

}  // namespace

WatchedPairs::WatchedPairs(const SelfContact& surfaces, int n_vertices)
    : surfaces_(surfaces),
      n_cloth_(n_vertices),
      reach_(kReach * largest_gap(surfaces)),
      near_(near_pairs(surfaces, n_vertices)),
      widths_(static_cast<std::size_t>(n_vertices), std::numeric_limits<double>::infinity()) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& face : surfaces.faces) {
    const double altitude = least_altitude(surfaces.rest_positions, face);
    for (const VertexId v : face) widths_[v] = std::min(widths_[v], altitude);
    least = std::min(least, altitude);
  }
  is_thick_ = least < 4 * surfaces.thickness;
  // Bodies go as they are told: what their wide faces may leave to either side would be watched.
  for (const BodySurface& body : surfaces.bodies) {
    first_vertex_.push_back(static_cast<int>(widths_.size()));
    widths_.resize(widths_.size() + static_cast<std::size_t>(body.n_vertices()), least);
  }
  first_incident_.assign(widths_.size() + 1, 0);
}

// Vertices of a body come last in a pair with cloth, but for one that meets a face.
int WatchedPairs::body_of(const SurfacePair& pair) const {
  const int last = std::max(pair.vertices[0], pair.vertices[3]);
  if (last < n_cloth_) return -1;
  const auto after = std::upper_bound(first_vertex_.begin(), first_vertex_.end(), last);
  return static_cast<int>(after - first_vertex_.begin()) - 1;
}

bool WatchedPairs::cover(const Positions& places, VertexId vertex, double time) const {
  const double share = (time - time_begin_) / (time_end_ - time_begin_);
  const double room = kSureRoom * corridors_.rooms[vertex];
  const double* const begin = corridors_.begins.data() + 3 * vertex.value;
  const double* const end = corridors_.ends.data() + 3 * vertex.value;
  const double* const place = places.data() + 3 * vertex.value;
  for (int k = 0; k < 3; ++k)
    if (!(std::abs(place[k] - (begin[k] + share * (end[k] - begin[k]))) <= room)) return false;
  return true;
}

bool WatchedPairs::cover(const Positions& places, double time) const {
  if (!(time <= time_end_ && time >= time_begin_)) return false;
  for (int i = 0; i < places.cols(); ++i)
    if (!cover(places, VertexId(i), time)) return false;
  return true;
}

// Corridors that lasted for all their time may be longer the next time, and others shorter.
bool WatchedPairs::list(const Positions& begins, const Positions& ends, double begin, double end) {
  const double h = end - begin;
  const bool lasted = begin >= time_end_ - 0.5 * h;
  slack_ = std::clamp(lasted ? 2 * slack_ : slack_ / 2, 1.0, kMostSubsteps);
  corridors_.begins = begins;
  corridors_.ends = begins + slack_ * (ends - begins);
  corridors_.rooms.resize(begins.cols());
  for (int i = 0; i < begins.cols(); ++i)
    corridors_.rooms[i] = std::isfinite(widths_[static_cast<std::size_t>(i)])
                              ? std::max(kRoomOfWidth * widths_[static_cast<std::size_t>(i)],
                                         0.5 * surfaces_.thickness)
                              : std::numeric_limits<double>::max();
  time_begin_ = begin;
  time_end_ = begin + slack_ * h;
  return detect(false);
}

bool WatchedPairs::add(const Positions& begins, const Positions& ends, double begin, double end) {
  corridors_.begins = begins;
  corridors_.ends = ends;
  slack_ = 1;
  time_begin_ = begin;
  time_end_ = end;
  return detect(true);
}

// Along a fixed direction all differences are linear in time: what is far enough apart at both ends
// is so all along. Rooms are of each axis.
bool WatchedPairs::stay_apart(const SurfacePair& pair, Vec3& normal) const {
  const auto differences = pair_differences(pair, corridors_.begins);
  const Vec3 closest = closest_points(differences, pair.n_differences()).difference;
  const double distance = closest.norm();
  if (!(distance > 0)) return false;
  normal = closest / distance;
  const double spread = normal.cwiseAbs().sum();
  const int n_first = pair.n_first();
  int k = 0;
  for (int a = 0; a < n_first; ++a)
    for (int b = n_first; b < 4; ++b, ++k) {
      const double reach =
          spread * (corridors_.rooms[pair.vertices[a]] + corridors_.rooms[pair.vertices[b]]) +
          reach_;
      const Vec3 at_end =
          corridors_.ends.col(pair.vertices[b]) - corridors_.ends.col(pair.vertices[a]);
      if (!(normal.dot(differences[k]) >= reach && normal.dot(at_end) >= reach)) return false;
    }
  return true;
}

double WatchedPairs::rest_gap(const SurfacePair& pair, int body) const {
  if (body >= 0) return surfaces_.body_gap;
  if (!is_thick_) return surfaces_.thickness;
  const double distance =
      closest_points(pair_differences(pair, surfaces_.rest_positions), pair.n_differences())
          .difference.norm();
  return std::min(surfaces_.thickness, 0.5 * distance);
}

bool WatchedPairs::detect(bool keeps_all) {
  ++n_lists_;
  if (!near_.detect(corridors_, reach_)) {
    forget();
    return false;
  }
  std::swap(pairs_, before_);
  pairs_.clear();
  auto known = before_.cbegin();
  for (const SurfacePair& sides : near_.pairs()) {
    for (; known != before_.cend() && known->sides < sides; ++known)
      if (keeps_all) pairs_.push_back(*known);
    const bool is_known = known != before_.cend() && known->sides == sides;
    WatchedPair pair;
    if (is_known) pair = *known++;
    if (!keeps_all && stay_apart(sides, pair.normal)) continue;
    if (!is_known) {
      pair.body = body_of(sides);
      pair.gap = rest_gap(sides, pair.body);
    }
    pair.sides = sides;
    pairs_.push_back(pair);
  }
  if (keeps_all) pairs_.insert(pairs_.end(), known, before_.cend());
  connect();
  return true;
}

void WatchedPairs::connect() {
  std::fill(first_incident_.begin(), first_incident_.end(), 0);
  for (const WatchedPair& pair : pairs_)
    for (const VertexId v : pair.sides.vertices) ++first_incident_[v];
  int sum = 0;
  for (int& first : first_incident_) sum += std::exchange(first, sum);
  incident_.resize(static_cast<std::size_t>(sum));
  for (int p = 0; p < static_cast<int>(pairs_.size()); ++p)
    for (const VertexId v : pairs_[static_cast<std::size_t>(p)].sides.vertices)
      incident_[static_cast<std::size_t>(first_incident_[v]++)] = p;
  for (std::size_t v = first_incident_.size() - 1; v > 0; --v)
    first_incident_[v] = first_incident_[v - 1];
  first_incident_[0] = 0;
}

std::size_t WatchedPairs::bytes() const {
  return near_.bytes() + (pairs_.capacity() + before_.capacity()) * sizeof(WatchedPair) +
         (incident_.capacity() + first_incident_.capacity()) * sizeof(int) +
         static_cast<std::size_t>(corridors_.begins.size()) * 2 * sizeof(double) +
         2 * widths_.size() * sizeof(double);
}

}  // namespace pleat
