#pragma once

#include <vector>

#include "core/contact/motion_guard.h"
#include "core/contact/watched_pairs.h"

namespace pleat {

/// Pushes sides apart that would end a substep nearer than they rest, and rubs them by Coulomb's
/// law. Impulses never pull, act between closest points alike on both sides, and are the first
/// guess of the next substep's.
class PairResponse {
 public:
  /// pairs, movers  outlive it
  PairResponse(WatchedPairs& pairs, Movers& movers, double friction)
      : pairs_(pairs), movers_(movers), friction_(friction) {}

  /// Finds what presses in a substep with these ways [m], and starts with the last impulses.
  void start(const Positions& begins, Positions& ends);
  /// Changes the ends of ways, and velocities with them, until sides keep their gaps. Call it again
  /// when something else has moved them.
  void push(const Positions& begins, Positions& ends);
  /// Ends a substep: what pushed is remembered.
  void finish(const Positions& begins, const Positions& ends);
  /// Moves sides that were too near from the start some way apart, velocities as they are. True
  /// where there were any.
  bool part(Positions& ends);

  /// Pairs that push.
  int n_active() const { return n_active_; }

 private:
  struct Contact {
    int pair;
    std::array<double, 4> weights;  // one of each vertex: negative on the first side
    Vec3 normal;
    double resistance;  // effective mass [kg]
    double wanted;      // least end of the gap [m]
    double push = 0;    // [kg m]
    Vec3 rub{0, 0, 0};  // friction across the normal [kg m]
  };

  void collect(const Positions& begins, const Positions& ends);
  void pull(const Contact& contact, const Vec3& impulse, Positions& ends);
  double solve_once(Contact& contact, const Positions& begins, Positions& ends);

  WatchedPairs& pairs_;
  Movers& movers_;
  double friction_;
  std::vector<Contact> contacts_;
  int n_active_ = 0;
};

}  // namespace pleat
