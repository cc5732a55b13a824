#pragma once

#include <span>
#include <vector>

#include "core/contact/contact_pass.h"
#include "core/model/state.h"
#include "core/model/system_matrix.h"

namespace pleat {

/// Lets the cloth around a touched vertex know in the solve itself that a solid holds it.
///
/// A vertex that a solid touched in the last substep is held by a resistance as large as its own:
/// to the solid's velocity altogether if it sticks, and if it slips, along the normal, onto the
/// solid's surface where it will be. What that exerts joins the remembered contact force, which
/// thereby converges as a multiplier does.
///
/// Source: Hestenes, Multiplier and gradient methods, Journal of Optimization Theory and
/// Applications 4, 1969; docs/methods/contact.md.
class ContactHold {
 public:
  /// share  of what a vertex resists with alone, with which it is held
  explicit ContactHold(const ClothModel& model, double share = 1);

  /// Hold on a touched vertex: the force R (u - v)/h at its velocity v.
  struct Held {
    VertexId vertex;
    Mat3 resistance;  // R [kg]
    Vec3 velocity;    // u, that it is held to [m/s]
  };

  /// Takes them from the matrix of a substep without holds; mass_unit turns its entries into kg.
  void set_resistances(const SystemMatrix& matrix, double mass_unit = 1);
  void set_resistances(const Eigen::VectorXd& resistances) { resistances_ = resistances; }

  /// Says which vertices are held in the substep that the contact pass is at.
  void choose(std::span<const ContactPass::Touch> touches, const State& begin, double h);
  std::span<const Held> held() const { return held_; }

  /// Adds what holds them to A dv = rhs, a linearised step from these velocities, A in kg.
  void add(const Positions& velocities, SystemMatrix& matrix, PositionsRef rhs) const;

  /// Adds the forces that they exert at the velocities of the solution [m/s].
  void add_forces(const Positions& velocities, double h, Positions& forces) const;

  /// How much each vertex alone resists a change of its velocity [kg]: the mass of a free one.
  const Eigen::VectorXd& resistances() const { return resistances_; }

 private:
  const ContactPass& contact_;
  double share_;
  Eigen::VectorXd resistances_;
  std::vector<Held> held_;
};

}  // namespace pleat
