#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/dynamics/cloth_contact.h"
#include "core/model/state.h"
#include "core/model/system_matrix.h"

namespace pleat {

/// Lets both sides of a pair that presses know of each other in the solve itself.
///
/// The way of the second side beyond the first's is held with a resistance as large as what its
/// vertices have alone: along the normal to where the gap ends, and across it as long as friction
/// sticks. What that exerts joins the pair's remembered force, which thereby converges as a
/// multiplier does. It acts alike on both sides: common motion is free.
///
/// Source: Hestenes, Multiplier and gradient methods, Journal of Optimization Theory and
/// Applications 4, 1969; docs/methods/contact.md.
class PairHold {
 public:
  /// How often a substep is solved anew with pairs that came loose.
  static constexpr int kMaxRepeats = 8;

  /// Outlive it.
  PairHold(const ClothModel& model, const ClothContact& contact)
      : model_(model), contact_(contact) {}

  /// A vertex that moves freely, with its share in the way of a pair.
  struct Term {
    VertexId vertex;
    double factor = 0;
  };
  /// Hold on a pair: the force R (u - v)/h at its sum v of velocities, on each vertex by its
  /// factor.
  struct Held {
    int pair = -1;  // number in the list of pairs
    std::array<Term, 8> terms;
    std::size_t n_terms = 0;
    double stiffness = 0;            // R's in the directions that are held [kg]
    Mat3 resistance = Mat3::Zero();  // R [kg]
    Vec3 velocity{0, 0, 0};          // u, what prescribed vertices do taken off [m/s]
    Vec3 normal{0, 0, 0};            // unit, towards the second side
    Vec3 force{0, 0, 0};             // remembered one, among the loads [N]
    double mass = 0;                 // resistance to a change of velocity, alone [kg]
    bool may_be_freed = true;
    bool sticks = false;

    std::span<const Term> parts() const { return {terms.data(), n_terms}; }
    /// Sum of the columns of its vertices, by their factors.
    Vec3 sum_of(const Positions& columns) const;
  };

  /// Chooses the pairs of the substep from `state` that press already, or are about to.
  void choose(const State& state, double time_end, double h);
  /// Chooses those that press cloth that is at rest, or would if it fell for h [s].
  void choose_at_rest(const State& state, double time, double h);
  std::span<const Held> held() const { return held_; }

  /// True where the matrix has a block for every two vertices that a pair joins.
  bool fits(const SystemMatrix& matrix) const;
  /// Vertices that pairs join, or may soon, for the pattern of a matrix.
  std::vector<std::array<VertexId, 2>> joins() const;

  /// Takes resistances from the matrix of a substep without holds; mass_unit turns its entries
  /// into kg.
  void set_resistances(const SystemMatrix& matrix, double mass_unit = 1);
  /// resistances  one for each vertex, alone [kg]
  void set_resistances(const Eigen::VectorXd& resistances);

  /// Adds the forces that pairs exerted in the last substep [N].
  void add_remembered(Positions& forces) const;

  /// Frees those that would pull at these velocities [m/s], and lets those slip that would rub
  /// beyond friction. Gives what their holds lost, which has to be taken out of the equations;
  /// valid until the next call.
  std::span<const Held> let_loose(const Positions& velocities, double h);

  /// Units of an equation: what 1 kg of its matrix is, and 1 N s of its right-hand side. Negative
  /// ones take out.
  struct Units {
    double matrix, rhs;
  };
  /// Adds what holds them to A dv = rhs, a linearised step from these velocities [m/s].
  static void add(std::span<const Held> held, const Positions& velocities, double h, Units units,
                  SystemMatrix& matrix, PositionsRef rhs);

  /// Hands the forces that they exert at the velocities of the solution [m/s] to their pairs.
  void remember(const Positions& velocities, double h, ClothContact& contact) const;

 private:
  void choose_from(const State& state, double time_end, double h);
  void take_in(const PairContact& contact, double h);
  bool closes(const PairContact& contact, const WatchedPair& pair) const;
  bool free_pulling(Held& held, const Vec3& force) const;
  bool let_slip(Held& held, const Vec3& force) const;

  const ClothModel& model_;
  const ClothContact& contact_;
  Positions begins_,
      ends_;                     // vertices of cloth and bodies; cloth goes on as it does [m]
  Eigen::VectorXd resistances_;  // each vertex's [kg]
  std::vector<Held> held_, lost_;
};

}  // namespace pleat
