#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/base/pose.h"
#include "core/contact/self_contact.h"
#include "core/contact/watched_pairs.h"

namespace pleat {

/// Vertices by what moves them: how much they resist, and which others they hang from.
class Movers {
 public:
  /// masses  one per vertex [kg]; 0 where it hangs
  Movers(const Eigen::VectorXd& masses, std::span<const HangingVertex> hanging);

  /// Says for each vertex whether its way is prescribed.
  void prescribe(std::span<const char> is_prescribed);

  /// Rigid body, with the vertices after those of the bodies before.
  struct RigidBody {
    int end = 0;              ///< end of its vertices
    std::optional<Pose> way;  ///< motion over the substep; none if it stands
  };
  /// The last vertices, all prescribed, are of these bodies.
  void carry(int first_vertex, std::span<const RigidBody> bodies) {
    first_carried_ = first_vertex;
    bodies_ = bodies;
  }
  /// Body that moves and carries a vertex; null for most.
  const RigidBody* carrier(VertexId vertex) const;

  /// 1 / mass [1/kg]; of a vertex that hangs, of both parents. 0 where one is prescribed.
  double inverse_mass(VertexId vertex) const { return inverse_masses_[vertex]; }
  /// Vertices that move it: itself twice, or its parents.
  const std::array<VertexId, 2>& carriers(VertexId vertex) const { return parents_[vertex]; }
  /// Moves a vertex; of one that hangs both parents, as far.
  void move(VertexId vertex, const Vec3& way, Positions& places);
  /// Moves it and does not note it as moved. Runs for every pair that presses, hence inline.
  void shift(VertexId vertex, const Vec3& way, Positions& places) const {
    if (children_.empty())
      places.col(vertex) += way;
    else
      shift_with_parents(vertex, way, places);
  }
  /// Vertices moved since the last `clear_moved`, each once, those that hang too.
  std::span<const VertexId> moved() const { return moved_; }
  void clear_moved();

 private:
  void note(VertexId vertex);
  void shift_with_parents(VertexId vertex, const Vec3& way, Positions& places) const;

  Eigen::VectorXd masses_, inverse_masses_;
  std::vector<std::array<VertexId, 2>> parents_;  // itself twice unless it hangs
  std::vector<std::vector<VertexId>> children_;   // empty if none hangs
  std::vector<VertexId> moved_;
  std::vector<char> is_moved_;
  int first_carried_ = std::numeric_limits<int>::max();
  std::span<const RigidBody> bodies_;
};

/// Shortens what a stepper proposes until no side of a watched pair passes through the other.
class MotionGuard {
 public:
  /// All outlive it.
  MotionGuard(WatchedPairs& pairs, Movers& movers) : pairs_(pairs), movers_(movers) {}

  /// Shortens ways from `begins` to `ends` [m], which take from `begin` to `end` [s], and pushes
  /// what prescribed vertices meet. Pairs that are apart at the begin are so at the end.
  HeldBack hold(const Positions& begins, Positions& ends, double begin, double end);
  /// Holds all vertices as one: they go on by their mean motion, or by that of what is prescribed.
  HeldBack hold_all(const Positions& begins, Positions& ends);

 private:
  bool is_free(WatchedPair& pair, const Positions& begins, const Positions& ends);
  /// Share of what a gap lacks that the first side is to give.
  double share_of_first(const SurfacePair& sides, const Vec3& n, const Positions& begins,
                        const Positions& ends) const;
  /// Opens the gap along n by what it lacks at the end.
  void open(const SurfacePair& sides, const Vec3& n, double missing, double share, Positions& ends);
  void shorten(const WatchedPair& pair, const Positions& begins, Positions& ends);
  bool settle(const Positions& begins, Positions& ends);
  bool hold_clusters(const Positions& begins, Positions& ends);
  HeldBack loss(const Positions& ends) const;
  void clear_clusters(std::size_t n_vertices);
  bool join(VertexId vertex, VertexId other);
  bool move_clusters(const Positions& begins, Positions& ends);
  void find_failing(const Positions& begins, const Positions& ends);

  WatchedPairs& pairs_;
  Movers& movers_;
  Positions proposed_;
  std::vector<int> failing_, candidates_;
  // Motion of vertices that are held as one.
  struct Cluster {
    Vec3 momentum{0, 0, 0};  // times time [kg m]
    Vec3 prescribed{0, 0, 0};
    const Movers::RigidBody* carrier = nullptr;
    double mass = 0;  // [kg]
    bool has_prescribed = false, is_torn = false;
  };
  std::vector<int> next_in_cluster_;  // another of each vertex's cluster, itself at the root
  std::vector<Cluster> clusters_;     // one at each root
  std::vector<VertexId> in_clusters_;
  std::vector<char> is_in_cluster_;
};

}  // namespace pleat
