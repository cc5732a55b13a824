#pragma once

#include <span>
#include <vector>

#include "core/model/cloth_model.h"
#include "core/model/state.h"
#include "core/model/stretch.h"

namespace pleat {

/// The pull of a hand [N], on cloth as wide as it holds: two kilogrammes, which an arm lifts with
/// ease.
constexpr double kHandPull = 20;
/// Stretch that a hand gives no thread more than: woven cloth bears it.
constexpr double kHandStretch = 0.1;
constexpr double kHandSpeed = 10;  ///< [m/s], of an arm that throws

/// Bounds of a hand by the threads that it pulls: those between what it holds and the cloth around
/// stretch by kHandStretch at most, and the ways along the cloth to the pins that hold it elsewhere
/// by what the hand's pull is worth; neither is drawn in that was longer when the hand took hold.
/// Source: Kim, Chentanez, Mueller-Fischer, Long range attachments, SCA 2012, whose lengths the
/// latter are; Boyle, Dykstra, A method for finding projections onto the intersection of convex
/// sets in Hilbert spaces, 1986; docs/methods/plausibility.md.
class HandReach {
 public:
  /// Thread from a vertex that the hand holds to one beside it.
  struct Thread {
    VertexId held, beside;
    double longest;  // [m]
  };
  /// The grabbed vertex when the hand takes hold.
  struct Grip {
    Vec3 place;     // [m]
    double time;    // [s]
    double radius;  // the hand's: what it holds does not stretch [m]
  };

  /// ways     length along the cloth at rest from the grabbed vertex to each vertex [m]
  /// pins     without those that the hand moves
  /// threads  between what the hand holds and what is beside it
  /// stretch  by which the pull lengthens the rest of a way [1]
  HandReach(const Eigen::VectorXd& ways, std::span<const Pin> pins, std::vector<Thread> threads,
            const Grip& grip, double stretch);

  /// Move of the hand [m] in the coming step of length h [s], which ends at time_end [s]: towards
  /// the place nearest to the target that the threads allow, as far as they allow the way, and no
  /// faster than kHandSpeed. Projections find that place within millimetres after some calls with
  /// the same target.
  Vec3 move(const State& state, VertexId grabbed, const Vec3& target, double time_end, double h);
  /// Largest distance of the target [m] from a pin at this time [s] over the way to it at rest; 0
  /// without pins.
  double asked(const Vec3& target, double time) const;

 private:
  struct Tether {
    Pin pin;
    double length;   // length at rest [m]
    double longest;  // [m]
  };
  struct Ball {
    Vec3 centre;
    double radius;
  };
  void place_balls(const State& state, VertexId grabbed, double time_end, double h);
  Vec3 nearest(const Vec3& target);
  static double share_in(const Ball& ball, const Vec3& begin, const Vec3& way);

  std::vector<Tether> tethers_;
  std::vector<Thread> threads_;
  std::vector<Ball> balls_;   // bounds of the grabbed vertex's place at the end of a step
  std::vector<Vec3> pushes_;  // moves by which each keeps the place from the target [m]
};

/// Lengths of the shortest ways along edges from a vertex to all [m]; infinite to other pieces.
Eigen::VectorXd ways_along(std::span<const GaugeEdge> edges, VertexId from, int n_vertices);

}  // namespace pleat
