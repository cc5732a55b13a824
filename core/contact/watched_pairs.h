#pragma once

#include <span>
#include <vector>

#include "core/contact/near_pairs.h"
#include "core/contact/self_contact.h"
#include "core/contact/surface_pair.h"

namespace pleat {

/// A pair that may come to touch, with what is known of it from substep to substep.
struct WatchedPair {
  SurfacePair sides;
  std::int32_t body = -1;  ///< body that one side is of, if any
  Vec3 normal{0, 0, 0};  ///< direction from the first side to the second, tried first: zero or unit
  double gap = 0;        ///< gap that the sides rest at [m]
  Vec3 force{0, 0, 0};   ///< force of the first side on the second in the last substep [N]
  double force_before = 0;  ///< size of the force in the substep before that [N]
  Vec3 slip{0, 0, 0};       ///< way that friction has still to undo [m]
  bool sticks = false;      ///< friction took all of the way across the normal
  bool is_solved = false;   ///< the force acts in the solve of the substep already
};

/// Keeps a list of all pairs that may meet while each vertex stays in its corridor: the line that
/// it was on when the list was made, with room to either side.
class WatchedPairs {
 public:
  /// surfaces    outlives it
  /// n_vertices  of the cloth: those of bodies come after them
  WatchedPairs(const SelfContact& surfaces, int n_vertices);

  /// True while the places at the time are within the corridors, and the time within theirs.
  bool cover(const Positions& places, double time) const;
  bool cover(const Positions& places, VertexId vertex, double time) const;

  /// Lists anew what may meet from `begin` to `end` [s], if ways go on straight, and for some time
  /// after. What was known of a pair stays known. False where so many may meet that a list is no
  /// use: then there is none, and the next `cover` fails.
  bool list(const Positions& begins, const Positions& ends, double begin, double end);
  /// Adds what may meet, of these ways alone.
  bool add(const Positions& begins, const Positions& ends, double begin, double end);
  /// Makes the next `cover` fail.
  void forget() { time_end_ = time_begin_ - 1; }

  /// Ascending.
  std::span<WatchedPair> pairs() { return pairs_; }
  std::span<const WatchedPair> pairs() const { return pairs_; }
  /// Numbers of the pairs that a vertex is in.
  std::span<const int> with(VertexId vertex) const {
    return {incident_.data() + first_incident_[vertex],
            incident_.data() + first_incident_[vertex + 1]};
  }

  /// Coulomb coefficient of the two sides.
  double friction(const WatchedPair& pair) const {
    return pair.body < 0 ? surfaces_.friction
                         : surfaces_.bodies[static_cast<std::size_t>(pair.body)].friction;
  }

  /// Lists made so far.
  int n_lists() const { return n_lists_; }
  std::size_t bytes() const;

 private:
  bool stay_apart(const SurfacePair& pair, Vec3& normal) const;
  int body_of(const SurfacePair& pair) const;
  double rest_gap(const SurfacePair& pair, int body) const;
  bool detect(bool keeps_all);
  void connect();

  const SelfContact& surfaces_;
  int n_cloth_;                    // vertices of the cloth
  std::vector<int> first_vertex_;  // first vertex of each body
  double reach_;                   // distance from which pairs are watched [m]
  NearPairs near_;
  std::vector<double> widths_;  // least altitude of the faces around each vertex [m]
  bool is_thick_ = false;       // some faces are near at rest: gaps are the pair's own
  Corridors corridors_;
  double time_begin_ = 0, time_end_ = -1;  // time of the corridors [s]
  double slack_ = 1;                       // substeps that the last corridors were made for
  std::vector<WatchedPair> pairs_, before_;
  std::vector<int> incident_, first_incident_;
  int n_lists_ = 0;
};

}  // namespace pleat
