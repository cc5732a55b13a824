#pragma once

#include <span>
#include <vector>

#include "core/model/cloth_model.h"
#include "core/model/state.h"

namespace pleat {

/// Forces with which solids held vertices in one substep may be among the forces of the next: cloth
/// then rests in equilibrium instead of falling into the solid and being put back in every substep.
enum class ContactForces { forgotten, remembered };

/// Knows from one substep to the next how solids touched the cloth, and with what force they held
/// each vertex. Source: docs/methods/contact.md.
class ContactMemory {
 public:
  using Touch = ContactPass::Touch;

  /// Forces are remembered only where the model has solids on which cloth rests.
  ContactMemory(const ClothModel& model, ContactForces wanted);

  void begin_substep() { is_touched_ = false; }
  /// Says for each vertex whether contact leaves it alone, as it hangs or is pinned.
  std::span<const char> exempt();

  /// Takes what the remembered forces did in the substep out of the state that it proposes, before
  /// contact corrects that.
  ///
  /// resistances, travel_share  as of Stepper::correct
  void let_go(State& state, double h, const Eigen::VectorXd& resistances, double travel_share);
  /// Makes the forces of the next substep of what contact did with that state.
  void remember(std::span<const Touch> touches, const Positions& positions_begin,
                const State& state, double h, const Eigen::VectorXd& resistances);

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
  double friction_of(const Touch& touch) const;
  void forget_untouched();
  void add_friction(const Positions& positions_begin, const State& state, double h,
                    const Eigen::VectorXd& resistances);
  void add_forces(std::span<const Touch> touches, const Positions& velocities, double h);

  const ClothModel& model_;
  Positions forces_;
  std::vector<Touch> touches_;   // last substep's, in the order of the vertices
  std::vector<char> is_exempt_;  // one for each vertex; empty without contact
  bool is_touched_ = false;
  Positions solved_velocities_;  // velocities before contact [m/s]
};

}  // namespace pleat
