#pragma once

#include <span>
#include <vector>

#include "core/model/cloth_model.h"
#include "core/model/state.h"
#include "core/model/stretch.h"

namespace pleat {

/// The pull of a hand [N], on cloth as wide as it holds.
constexpr double kHandPull = 20;
/// Stretch that a hand gives no thread more than: woven cloth bears it.
constexpr double kHandStretch = 0.1;
constexpr double kHandSpeed = 10;  ///< [m/s], of an arm that throws

/// Bounds of a hand by the threads that it pulls: those between what it holds and the cloth around
/// stretch by kHandStretch at most, and the ways along the cloth to the pins that hold it elsewhere
/// by what the hand's pull is worth. Source: Kim, Chentanez, Mueller-Fischer, Long range
/// attachments, SCA 2012, whose lengths the latter are; docs/methods/plausibility.md.
class HandReach {
 public:
  /// Thread from a vertex that the hand holds to one beside it.
  struct Thread {
    VertexId held, beside;
    double length;  // length at rest [m]
  };

  /// ways     length along the cloth at rest from the grabbed vertex to each vertex [m]
  /// pins     without those that the hand moves
  /// radius   the hand's [m]: what it holds does not stretch
  /// stretch  by which the pull lengthens the rest of a way
  HandReach(const Eigen::VectorXd& ways, std::span<const Pin> pins, std::vector<Thread> threads,
            double radius, double stretch);

  /// Move of the hand in the coming step of length h [m]: towards the place nearest to the target
  /// that the threads allow, as a few cyclic projections find it, as far as they allow the way, and
  /// no faster than kHandSpeed.
  Vec3 move(const State& state, VertexId grabbed, const Vec3& target, double time_end, double h);
  /// Largest distance of the target from a pin over the way to it at rest; 0 without pins.
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
  static double share_in(const Ball& ball, const Vec3& begin, const Vec3& way);

  std::vector<Tether> tethers_;
  std::vector<Thread> threads_;
  std::vector<Ball> balls_;  // bounds of the grabbed vertex's place at the end of a step
};

/// Lengths of the shortest ways along edges from a vertex to all [m]; infinite to other pieces.
Eigen::VectorXd ways_along(std::span<const GaugeEdge> edges, VertexId from, int n_vertices);

}  // namespace pleat
