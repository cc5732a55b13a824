#pragma once

#include <span>
#include <vector>

#include "core/model/cloth_model.h"
#include "core/model/state.h"

namespace pleat {

/// Forces with which solids held vertices in one substep may be among the forces of the next: cloth
/// then rests in equilibrium instead of falling into the solid and being put back in every substep.
enum class ContactForces { forgotten, remembered };

/// Force by which a solid presses a vertex, as far as friction goes by it: how much one that slips
/// is braked, and whether one sticks.
enum class Pressing {
  remembered,   ///< force of the last substep
  of_own_mass,  ///< force that stops its mass: of steppers whose solve leaves much
};

/// Knows from one substep to the next how solids touched the cloth, and with what force they held
/// each vertex. Source: docs/methods/contact.md.
class ContactMemory {
 public:
  using Touch = ContactPass::Touch;

  /// Hold that is foreseen for a vertex: on the solid's surface, where it will be.
  struct Plan {
    Touch touch;
    Vec3 normal{0, 0, 0};    // unit, the solid's there
    Vec3 velocity{0, 0, 0};  // velocity that leads there [m/s]
    double grip = 0;         // share of the hold along the normal with which it is held across it
    double resistance = 0;   // how much the vertex alone resists along the normal [kg]
    double owed = 0;         // friction that is left to it should it leave [N]
    bool leaves = false;     // a solve found the solid pulling it
  };

  /// Forces are remembered only where the model has solids on which cloth rests.
  ContactMemory(ClothModel& model, ContactForces wanted);

  void begin_substep() { is_touched_ = false; }
  /// Says for each vertex whether contact leaves it alone, as it hangs or is pinned.
  std::span<const char> exempt();

  /// Says how vertices will be held that a solid touched in the last substep, or meets in this one,
  /// and turns the remembered forces to where they will be. Call it before these are summed.
  ///
  /// begin        start of the substep that the contact pass is at
  /// resistances  how much each vertex alone resists a change of its velocity [kg]
  /// share        share of it with which they are held
  /// pressing     see there
  void plan(const State& begin, double h, const Eigen::VectorXd& resistances, double share,
            Pressing pressing);
  /// Holds of this substep, in the order of their vertices; none without a plan.
  std::span<Plan> plans() { return plans_; }
  std::span<const Plan> plans() const { return plans_; }

  /// Friction coefficient of the solid that is touched.
  double friction_of(const Touch& touch) const;
  /// Lets a planned vertex slip in this substep, or leave its solid.
  void let_slip(VertexId vertex) { plan_of(vertex).grip = 0; }
  void let_leave(VertexId vertex) { plan_of(vertex).leaves = true; }

  /// Turns the remembered forces alone, of steppers that hold nothing.
  void turn_forces(const State& begin, double h);

  /// Ends the hold of planned vertices: those that a solid still presses come to lie on it, and the
  /// others are given back what pulled at them. Without a plan, takes what the remembered forces
  /// did in the substep out of the state that it proposes. Contact corrects that afterwards.
  ///
  /// resistances, travel_share  as of Stepper::correct
  void let_go(State& state, double h, const Eigen::VectorXd& resistances, double travel_share);
  /// Touches of planned vertices that lie on their solids, in their order.
  std::span<const Touch> settled() const { return settled_; }
  /// Makes the forces of the next substep of what contact did with that state.
  void remember(std::span<const Touch> touches, const State& state, double h);

  /// Lets a state be corrected once more in the substep, and adds what contact did.
  void keep(const State& state) {
    if (has_forces()) solved_velocities_ = state.velocities;
  }
  void add(std::span<const Touch> touches, const State& state, double h);

  /// Goes back to a substep that began with these forces.
  void restart(const Positions& forces);

  /// True when a solid touched the cloth in this substep.
  bool is_touched() const { return is_touched_; }
  const std::vector<Touch>& touches() const { return touches_; }
  /// The force [N] with which solids hold each vertex; no columns where none is remembered.
  Positions& forces() { return forces_; }
  const Positions& forces() const { return forces_; }
  bool has_forces() const { return forces_.cols() > 0; }

 private:
  Plan& plan_of(VertexId vertex);
  bool has_left(const Touch& touch, const State& begin, double h) const;
  void foresee(const State& begin, double h);
  Plan planned(const Touch& touch, const State& begin, double h, double resistance, Pressing of);
  void settle(const Plan& plan, State& state, double h, double resistance);
  void let_go(VertexId vertex, State& state, double h, double resistance,
              double travel_share) const;
  void forget_untouched();
  void add_forces(std::span<const Touch> touches, const Positions& velocities, double h);

  ClothModel& model_;
  Positions forces_;
  std::vector<Touch> touches_;   // last substep's, in the order of the vertices
  std::vector<Touch> foreseen_;  // first ones of this substep
  std::vector<Touch> settled_;
  std::vector<Plan> plans_;
  std::vector<char> is_exempt_;  // one for each vertex; empty without contact
  bool is_touched_ = false;
  bool is_planned_ = false;
  bool has_planned_ = false;     // any substep
  Positions positions_begin_;    // start of a planned substep
  Positions velocities_begin_;   // there [m/s]
  Eigen::VectorXd stopped_;      // momentum that settling took along the normal [N s]
  Positions solved_velocities_;  // velocities before contact [m/s]
};

}  // namespace pleat
