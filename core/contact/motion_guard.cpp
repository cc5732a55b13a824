#include "core/contact/motion_guard.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/contact/closest_points.h"
#include "core/contact/separator.h"

namespace pleat {
namespace {

/// Share of its gap that a pair keeps at least where it is shortened.
constexpr double kKept = 0.1;
/// Gap that it is never shortened below, in shares of the gap that it rests at.
constexpr double kFloor = 1e-3;
/// Share of that gap below which a pair is not apart.
constexpr double kTogether = 0.5;
/// Share of a lesser gap that is kept: all of it but for rounding.
constexpr double kSameGap = 1 - 1e-9;
constexpr int kMaxPasses = 12;
constexpr int kMaxLists = 4;

/// Sides of a pair along a normal.
struct Levels {
  double highest_first = -std::numeric_limits<double>::infinity();
  double lowest_second = std::numeric_limits<double>::infinity();
  double gap() const { return lowest_second - highest_first; }
};

Levels levels(const SurfacePair& pair, const Vec3& n, const Positions& x) {
  Levels levels;
  // Differences from one vertex: places far off cost no digits.
  const Vec3 origin = x.col(pair.vertices[0]);
  for (int k = 0; k < 4; ++k) {
    const double along = n.dot(x.col(pair.vertices[k]) - origin);
    if (k < pair.n_first())
      levels.highest_first = std::max(levels.highest_first, along);
    else
      levels.lowest_second = std::min(levels.lowest_second, along);
  }
  return levels;
}

double least_along(const Vec3& n, const std::array<Vec3, 4>& differences, int count) {
  double least = n.dot(differences[0]);
  for (int k = 1; k < count; ++k)
    least = std::min(least, n.dot(differences[static_cast<std::size_t>(k)]));
  return least;
}

int root(std::vector<int>& parents, int v) {
  while (parents[static_cast<std::size_t>(v)] != v) {
    parents[static_cast<std::size_t>(v)] =
        parents[static_cast<std::size_t>(parents[static_cast<std::size_t>(v)])];
    v = parents[static_cast<std::size_t>(v)];
  }
  return v;
}

}  // namespace

Movers::Movers(const Eigen::VectorXd& masses, std::span<const HangingVertex> hanging)
    : masses_(masses), is_moved_(static_cast<std::size_t>(masses.size()), 0) {
  for (int i = 0; i < masses.size(); ++i) parents_.push_back({VertexId(i), VertexId(i)});
  if (!hanging.empty()) children_.resize(parents_.size());
  for (const HangingVertex& h : hanging) {
    parents_[h.vertex] = h.parents;
    masses_[h.vertex] = masses[h.parents[0]] + masses[h.parents[1]];
    for (const VertexId parent : h.parents) children_[parent].push_back(h.vertex);
  }
  inverse_masses_ = masses_.cwiseInverse();
}

void Movers::prescribe(std::span<const char> is_prescribed) {
  for (int i = 0; i < masses_.size(); ++i) {
    const auto& [a, b] = parents_[static_cast<std::size_t>(i)];
    inverse_masses_[i] = is_prescribed[a] || is_prescribed[b] ? 0 : 1 / masses_[i];
  }
}

const Movers::RigidBody* Movers::carrier(VertexId vertex) const {
  if (vertex < first_carried_) return nullptr;
  const auto body = std::find_if(bodies_.begin(), bodies_.end(),
                                 [vertex](const RigidBody& one) { return vertex < one.end; });
  return body != bodies_.end() && body->way ? &*body : nullptr;
}

void Movers::note(VertexId vertex) {
  if (std::exchange(is_moved_[vertex], 1)) return;
  moved_.push_back(vertex);
}

void Movers::shift_with_parents(VertexId vertex, const Vec3& way, Positions& places) const {
  const auto& [a, b] = parents_[vertex];
  places.col(a) += way;
  if (a != b) places.col(b) += way;
  for (const VertexId v : {a, b})
    for (const VertexId child : children_[v]) {
      const auto& [c, d] = parents_[child];
      places.col(child) = (places.col(c) + places.col(d)) / 2;
    }
}

void Movers::move(VertexId vertex, const Vec3& way, Positions& places) {
  shift(vertex, way, places);
  for (const VertexId v : parents_[vertex]) {
    note(v);
    if (children_.empty()) continue;
    for (const VertexId child : children_[v]) note(child);
  }
}

void Movers::clear_moved() {
  for (const VertexId v : moved_) is_moved_[v] = 0;
  moved_.clear();
}

// A pair ends no nearer than the floor, so that nearer ones have never been apart: the lips of a
// tear, layers that start in one place. These are left alone until they are.
bool MotionGuard::is_free(WatchedPair& pair, const Positions& begins, const Positions& ends) {
  const PairWay way = pair_way(pair.sides, begins, ends);
  const double floor = kFloor * pair.gap;
  if (separates(pair.normal, way) && least_along(pair.normal, way.ends, way.count) >= floor)
    return true;
  const double distance = closest_points(way.begins, way.count).difference.norm();
  const auto ends_apart = [&](const Vec3& n) {
    return least_along(n, way.ends, way.count) >= kSameGap * std::min(floor, distance);
  };
  if (separates(pair.normal, way) && ends_apart(pair.normal)) return true;
  if (distance < kTogether * floor) return true;
  const std::optional<Vec3> normal = separator(way, pair.normal);
  if (!normal) return false;
  pair.normal = normal->normalized();
  return ends_apart(pair.normal);
}

// Each side takes as much as it approaches the pair's own mean motion; what is prescribed takes
// nothing.
double MotionGuard::share_of_first(const SurfacePair& sides, const Vec3& n, const Positions& begins,
                                   const Positions& ends) const {
  double mass = 0, mean = 0;
  bool all_free = true;
  std::array<double, 2> fastest = {-std::numeric_limits<double>::infinity(),
                                   std::numeric_limits<double>::infinity()};
  std::array<bool, 2> gives = {true, true};
  for (int k = 0; k < 4; ++k) {
    const VertexId v = sides.vertices[static_cast<std::size_t>(k)];
    const double way = n.dot(ends.col(v) - begins.col(v));
    const double inverse = movers_.inverse_mass(v);
    const bool is_second = k >= sides.n_first();
    if (inverse > 0) {
      mass += 1 / inverse;
      mean += way / inverse;
    } else {
      all_free = false;
      gives[is_second ? 1 : 0] = false;
    }
    fastest[is_second ? 1 : 0] = is_second ? std::min(fastest[1], way) : std::max(fastest[0], way);
  }
  if (!all_free) return gives[0] == gives[1] ? 0.5 : gives[0] ? 1 : 0;
  mean /= mass;
  const double first = std::max(0.0, fastest[0] - mean);
  const double second = std::max(0.0, mean - fastest[1]);
  return first + second > 0 ? first / (first + second) : 0.5;
}

// Momentum that this takes is given to all four alike: their differences, and so the gap, stay.
void MotionGuard::open(const SurfacePair& sides, const Vec3& n, double missing, double share,
                       Positions& ends) {
  const Levels levels_now = levels(sides, n, ends);
  const double first_level = levels_now.highest_first - share * missing;
  const double second_level = levels_now.lowest_second + (1 - share) * missing;
  const Vec3 origin = ends.col(sides.vertices[0]);
  std::array<double, 4> ways{};
  double mass = 0, taken = 0;
  bool all_free = true;
  for (int k = 0; k < 4; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double inverse = movers_.inverse_mass(sides.vertices[at]);
    all_free = all_free && inverse > 0;
    if (inverse == 0) continue;
    const double level = n.dot(ends.col(sides.vertices[at]) - origin);
    ways[at] = k < sides.n_first() ? std::min(0.0, first_level - level)
                                   : std::max(0.0, second_level - level);
    taken += ways[at] / inverse;
    mass += 1 / inverse;
  }
  const double back = all_free ? -taken / mass : 0;
  for (std::size_t k = 0; k < 4; ++k)
    if (movers_.inverse_mass(sides.vertices[k]) > 0 && ways[k] + back != 0)
      movers_.move(sides.vertices[k], (ways[k] + back) * n, ends);
}

// Takes the missing gap along the normal of the closest points alone.
void MotionGuard::shorten(const WatchedPair& pair, const Positions& begins, Positions& ends) {
  const SurfacePair& sides = pair.sides;
  const Vec3 closest =
      closest_points(pair_differences(sides, begins), sides.n_differences()).difference;
  const double distance = closest.norm();
  if (!(distance > 0)) return;
  const Vec3 n = closest / distance;
  const double gap = levels(sides, n, begins).gap();
  const double wanted = std::min(gap, std::max(kKept * gap, kFloor * pair.gap));
  const double missing = wanted - levels(sides, n, ends).gap();
  if (missing > 0) open(sides, n, missing, share_of_first(sides, n, begins, ends), ends);
}

// Looks at those that failed before, too: what is prescribed moves for none.
void MotionGuard::find_failing(const Positions& begins, const Positions& ends) {
  candidates_ = failing_;
  for (const VertexId v : movers_.moved())
    for (const int p : pairs_.with(v)) candidates_.push_back(p);
  std::sort(candidates_.begin(), candidates_.end());
  candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
  failing_.clear();
  for (const int p : candidates_)
    if (!is_free(pairs_.pairs()[static_cast<std::size_t>(p)], begins, ends)) failing_.push_back(p);
}

bool MotionGuard::settle(const Positions& begins, Positions& ends) {
  failing_.clear();
  const std::span<WatchedPair> pairs = pairs_.pairs();
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (!is_free(pairs[p], begins, ends)) failing_.push_back(static_cast<int>(p));
  for (int pass = 0; pass < kMaxPasses && !failing_.empty(); ++pass) {
    for (const int p : failing_) {
      WatchedPair& pair = pairs[static_cast<std::size_t>(p)];
      if (pass == 0 || !is_free(pair, begins, ends)) shorten(pair, begins, ends);
    }
    find_failing(begins, ends);
  }
  return failing_.empty() || hold_clusters(begins, ends);
}

/// True where they were not of one cluster yet.
bool MotionGuard::join(VertexId vertex, VertexId other) {
  bool is_new = false;
  for (const VertexId v : movers_.carriers(vertex)) {
    if (!std::exchange(is_in_cluster_[v], 1)) {
      in_clusters_.push_back(v);
      is_new = true;
    }
    const int from = root(next_in_cluster_, v);
    const int to = root(next_in_cluster_, movers_.carriers(other)[0]);
    is_new = is_new || from != to;
    next_in_cluster_[static_cast<std::size_t>(from)] = to;
  }
  return is_new;
}

// A prescribed motion is that of its cluster, which a body takes along; where two differ, nothing
// in it moves.
bool MotionGuard::move_clusters(const Positions& begins, Positions& ends) {
  for (const VertexId v : in_clusters_) clusters_[v] = {};
  for (const VertexId v : in_clusters_) {
    Cluster& cluster = clusters_[static_cast<std::size_t>(root(next_in_cluster_, v))];
    const Vec3 way = proposed_.col(v) - begins.col(v);
    if (const double inverse = movers_.inverse_mass(v); inverse > 0) {
      cluster.mass += 1 / inverse;
      cluster.momentum += way / inverse;
      continue;
    }
    const Movers::RigidBody* const carrier = movers_.carrier(v);
    const bool goes_along =
        carrier ? cluster.carrier == carrier : !cluster.carrier && cluster.prescribed == way;
    cluster.is_torn = cluster.is_torn || (cluster.has_prescribed && !goes_along);
    cluster.prescribed = way;
    cluster.carrier = carrier;
    cluster.has_prescribed = true;
  }
  bool is_met = true;
  for (const VertexId v : in_clusters_) {
    const Cluster& cluster = clusters_[static_cast<std::size_t>(root(next_in_cluster_, v))];
    is_met = is_met && !cluster.is_torn;
    if (!cluster.is_torn && movers_.carrier(v)) continue;  // it is where it is to be
    const Vec3 way = cluster.is_torn   ? Vec3(0, 0, 0)
                     : cluster.carrier ? Vec3(*cluster.carrier->way * begins.col(v) - begins.col(v))
                     : cluster.has_prescribed ? cluster.prescribed
                                              : Vec3(cluster.momentum / cluster.mass);
    movers_.move(v, begins.col(v) + way - ends.col(v), ends);
  }
  return is_met;
}

void MotionGuard::clear_clusters(std::size_t n_vertices) {
  next_in_cluster_.resize(n_vertices);
  std::iota(next_in_cluster_.begin(), next_in_cluster_.end(), 0);
  clusters_.resize(n_vertices);
  is_in_cluster_.assign(n_vertices, 0);
  in_clusters_.clear();
}

// Vertices of failing pairs that hang together go on as one, by their mean motion: all their gaps
// stay. Pairs across the rim join, until none fails; there are finitely many vertices.
bool MotionGuard::hold_clusters(const Positions& begins, Positions& ends) {
  clear_clusters(static_cast<std::size_t>(begins.cols()));
  bool is_met = true;
  for (bool grows = true; grows && !failing_.empty();) {
    grows = false;
    for (const int p : failing_) {
      const auto& vertices = pairs_.pairs()[static_cast<std::size_t>(p)].sides.vertices;
      for (const VertexId v : vertices) grows = join(v, vertices[0]) || grows;
    }
    is_met = move_clusters(begins, ends);
    find_failing(begins, ends);
  }
  return is_met && failing_.empty();
}

HeldBack MotionGuard::loss(const Positions& ends) const {
  HeldBack held;
  for (const VertexId v : movers_.moved()) {
    const double loss = (ends.col(v) - proposed_.col(v)).squaredNorm();
    if (loss == 0) continue;
    ++held.n_vertices;
    held.squared_loss += loss;
  }
  return held;
}

HeldBack MotionGuard::hold_all(const Positions& begins, Positions& ends) {
  proposed_ = ends;
  movers_.clear_moved();
  clear_clusters(static_cast<std::size_t>(begins.cols()));
  for (int i = 0; i < begins.cols(); ++i) join(VertexId(i), VertexId(0));
  const bool is_met = move_clusters(begins, ends);
  HeldBack held = loss(ends);
  held.is_blocked = !is_met;
  return held;
}

HeldBack MotionGuard::hold(const Positions& begins, Positions& ends, double begin, double end) {
  // Contacts may have pushed ways out of the corridors that near pairs were listed for.
  if (!pairs_.cover(ends, end) && !pairs_.add(begins, ends, begin, end))
    return hold_all(begins, ends);
  proposed_ = ends;
  movers_.clear_moved();
  bool is_met = true;
  for (int lists = 0; lists < kMaxLists; ++lists) {
    is_met = settle(begins, ends) && is_met;
    if (std::all_of(movers_.moved().begin(), movers_.moved().end(),
                    [&](VertexId v) { return pairs_.cover(ends, v, end); })) {
      HeldBack held = loss(ends);
      held.is_blocked = !is_met;
      return held;
    }
    if (!pairs_.add(begins, ends, begin, end)) break;
  }
  ends = proposed_;
  return hold_all(begins, ends);
}

}  // namespace pleat
