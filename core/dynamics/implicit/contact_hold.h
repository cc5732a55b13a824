#pragma once

#include <span>
#include <vector>

#include "core/dynamics/contact_memory.h"
#include "core/model/state.h"
#include "core/model/system_matrix.h"

namespace pleat {

/// Lets the cloth around a touched vertex know in the solve itself that a solid holds it.
///
/// A vertex is held as ContactMemory plans it, with a resistance as large as its own: along the
/// normal onto the solid's surface where it will be, and across it as far as friction goes. What
/// that exerts joins the remembered contact force, which thereby converges as a multiplier does.
///
/// Source: Hestenes, Multiplier and gradient methods, Journal of Optimization Theory and
/// Applications 4, 1969; docs/methods/contact.md.
class ContactHold {
 public:
  /// How often a substep is solved anew with vertices that came loose: one or two find nearly all,
  /// but where a stretched sheet comes loose from its border.
  static constexpr int kMaxRepeats = 8;

  /// share     share of what a vertex resists with alone, with which it is held
  /// pressing  what friction of slipping vertices goes by
  explicit ContactHold(const ClothModel& model, double share = 1,
                       Pressing pressing = Pressing::remembered);

  /// Hold on a touched vertex: the force R (u - v)/h at its velocity v.
  struct Held {
    VertexId vertex;
    Mat3 resistance;      // R [kg]
    Vec3 velocity;        // u, that it is held to [m/s]
    Vec3 normal;          // unit, away from the solid
    double turn_force;    // force that turns its velocity round the solid [N]
    Vec3 force;           // remembered one, among the loads [N]
    bool may_be_freed;    // is held no longer where it would be pulled
    bool sticks;          // slips where it would be rubbed beyond friction
    double friction;      // coefficient
    double owed;          // friction that is left to it should it leave [N]
    bool leaves = false;  // a loss after which it is off the solid, and does not only slip
  };

  /// Takes them from the matrix of a substep without holds; mass_unit turns its entries into kg.
  void set_resistances(const SystemMatrix& matrix, double mass_unit = 1);
  void set_resistances(const Eigen::VectorXd& resistances) { resistances_ = resistances; }

  /// Has the memory plan the substep that the contact pass is at, and holds what it plans. The
  /// matrix, of which resistances were taken, may be null.
  void choose(ContactMemory& memory, const State& begin, double h,
              const SystemMatrix* matrix = nullptr, double mass_unit = 1);
  std::span<const Held> held() const { return held_; }

  /// Frees those whom a solid would pull back at these velocities [m/s], and lets those slip whom
  /// it would rub beyond friction. Gives what their holds lost, which has to be taken out of the
  /// equations; valid until the next call.
  std::span<const Held> let_loose(ContactMemory& memory, const Positions& velocities, double h);

  /// Adds what holds them to A dv = rhs, a linearised step from these velocities, A in kg.
  void add(const Positions& velocities, double h, SystemMatrix& matrix, PositionsRef rhs) const;
  /// Takes what holds have lost out of it.
  void take_out(std::span<const Held> lost, const Positions& velocities, double h,
                SystemMatrix& matrix, PositionsRef rhs) const;

  /// Adds the forces that they exert at the velocities of the solution [m/s].
  void add_forces(const Positions& velocities, double h, Positions& forces) const;

  /// How much each vertex alone resists a change of its velocity [kg]: the mass of a free one.
  const Eigen::VectorXd& resistances() const { return resistances_; }

 private:
  bool is_pulled(const Held& held, const Vec3& force) const;
  static Held freed(const Held& held, const Vec3& force);
  bool is_torn_loose(const Held& held, const Vec3& force) const;
  static Held slipping(const Held& held, const Vec3& force);

  const ClothModel& model_;
  double share_;
  Pressing pressing_;
  Eigen::VectorXd resistances_;
  std::vector<Held> held_;
  std::vector<Held> lost_;
};

}  // namespace pleat
