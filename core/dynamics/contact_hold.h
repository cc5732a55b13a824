#pragma once

#include <span>
#include <vector>

#include "core/contact/contact_stage.h"
#include "core/model/state.h"
#include "core/model/system_matrix.h"

namespace pleat {

/// Lets the cloth around a touched vertex know in the solve itself that a solid holds it.
///
/// A vertex that a solid touched in the last substep is held to the solid's velocity, along the
/// normal if it slips, altogether if it sticks, by a resistance as large as its own. What that
/// exerts joins the remembered contact force, which thereby converges as a multiplier does: the
/// resistance need not be large for the vertex to be held, and a vertex in equilibrium is held by
/// the force alone.
///
/// Source: Hestenes, Multiplier and gradient methods, Journal of Optimization Theory and
/// Applications 4, 1969; docs/methods/contact.md.
class ContactHold {
 public:
  explicit ContactHold(const ClothModel& model);

  /// A dv = rhs is a linearised step of h [s] from this state, A [kg] as far as it is assembled;
  /// the contact stage is at this substep. Adds what holds the touched vertices.
  void add(std::span<const ContactStage::Touch> touches, const State& state, SystemMatrix& matrix,
           Eigen::Ref<Positions> rhs);

  /// Adds the forces that they exert at the velocities of the solution [m/s].
  void add_forces(const Positions& velocities, double h, Positions& forces) const;

  /// How much each vertex alone resists a change of its velocity [kg]: the mass of a free one.
  const Eigen::VectorXd& resistances() const { return resistances_; }

 private:
  struct Held {
    VertexId vertex;
    Mat3 resistance;  // [kg]
    Vec3 velocity;    // to which it is held [m/s]
  };

  const ContactStage& contact_;
  Eigen::VectorXd resistances_;
  std::vector<Held> held_;
};

}  // namespace pleat
