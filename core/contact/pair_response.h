#pragma once

#include <vector>

#include "core/contact/motion_guard.h"
#include "core/contact/pair_contact.h"
#include "core/contact/watched_pairs.h"

namespace pleat {

/// Pushes sides apart that would end a substep nearer than they rest, and rubs them by Coulomb's
/// law. Impulses never pull, act between closest points alike on both sides, and are the first
/// guess of the next substep's.
class PairResponse {
 public:
  /// pairs, movers  outlive it
  PairResponse(WatchedPairs& pairs, Movers& movers) : pairs_(pairs), movers_(movers) {}

  /// Finds what presses in a substep of h [s] with these ways [m], and starts with the last forces,
  /// which act on those ends now that no solve knew of.
  void start(const Positions& begins, Positions& ends, double h);
  /// Changes the ends of ways, and velocities with them, until sides keep their gaps. Call it again
  /// when something else has moved them.
  void push(Positions& ends);
  /// Ends a substep of h [s]: what pushed is remembered.
  void finish(const Positions& ends, double h);
  /// Moves sides that were too near from the start some way apart, velocities as they are. True
  /// where there were any.
  bool part(Positions& ends);

  /// Pairs that push.
  int n_active() const { return n_active_; }

 private:
  struct Pressing : PairContact {
    explicit Pressing(const PairContact& contact) : PairContact(contact) {}
    std::array<VertexId, 4> vertices;
    std::array<double, 4> softnesses{};  // weights over masses [1/kg]
    double resistance = 0;               // effective mass [kg]
    double rest_gap = 0;                 // [m]
    double friction = 0;                 // Coulomb coefficient
    Vec3 begin{0, 0, 0};  // difference when the substep starts, less what friction is to undo [m]
    double push = 0;      // impulse along the normal times the substep [kg m]
    Vec3 rub{0, 0, 0};    // friction across it [kg m]
    bool slips = false;   // friction is all that there can be

    /// Sets the friction, as far as Coulomb's cone goes.
    void set_rub(const Vec3& impulse);

    /// The second side's point less the first's.
    Vec3 difference(const Positions& places) const;
  };

  Pressing pressing(const WatchedPair& pair, const PairContact& contact, const Positions& begins,
                    double h) const;
  void take_force(const WatchedPair& pair, double h, Pressing& contact) const;
  void collect(const Positions& begins, const Positions& ends, double h);
  void pull(const Pressing& contact, const Vec3& impulse, Positions& ends) const;
  double solve_once(Pressing& contact, Positions& ends) const;

  WatchedPairs& pairs_;
  Movers& movers_;
  std::vector<Pressing> contacts_;
  int n_active_ = 0;
};

}  // namespace pleat
