#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/dynamics/position_based/lanes/contact_program.h"
#include "core/dynamics/position_based/lanes/damper_program.h"
#include "core/dynamics/position_based/lanes/free_turns.h"
#include "core/dynamics/position_based/lanes/lane_projections.h"
#include "core/dynamics/position_based/spring_law.h"
#include "core/dynamics/stepper.h"
#include "core/dynamics/stepper_type.h"

namespace pleat {

/// Steps of position-based dynamics: per substep the vertices move freely, then constraints are
/// projected, what the projections moved changes the velocities, and dampers brake these. Inside,
/// single precision about a local origin, four constraints at a time; positions carry what single
/// precision rounds off, and velocities are summed from corrections, so that slow motion is not
/// lost and gravity is not rounded however small the substep. Hanging vertices have no motion of
/// their own: what pulls at one moves its parents.
///
/// Source: Macklin et al., Small steps in physics simulation, SCA 2019; docs/methods/xpbd.md.
class StepperPositionBased final : public Stepper {
 public:
  StepperPositionBased(ClothModel& model, const MethodOptions& options,
                       MakeProjections make_projections = lane_projections);

  void refresh() override;
  void refresh_rest_lengths() override;
  std::string remark() const override { return projections_->remark(); }

 protected:
  void load(const State& state) override;
  SolveReport substep(State& state, double time_end, double h) override;
  void store(State& state, SolveReport& report) override;
  void read_places(const State& state, PositionsRef places) const override;
  void change(State& state, VertexId vertex, const Vec3& place, const Vec3& velocity) override;

 private:
  /// Numbers of a slot, each in an array of its own, one after the other.
  ///
  /// A vertex is at begin + move. Single precision rounds `begin`; what it rounds off is
  /// `rounded_off` and is contained in the move, so that move - rounded_off is the velocity times
  /// h.
  ///
  /// `gained` is what gravity and projections added to the velocity in the last substep, times h;
  /// during a substep, the velocity that it began with. It exists where accelerations are carried.
  enum Array { begin, move = 3, rounded_off = 6, inverse_mass = 9, gained = 10, kArrays = 13 };

  /// The first three of them, each by x, y and z.
  struct MotionLanes {
    std::array<float*, 3> begins, moves, rounded_off;
  };

  bool carries() const { return options().carried_acceleration > 0; }
  static constexpr std::size_t kAirArrays = 9;

  float* array(int which) { return data_.data() + static_cast<std::size_t>(which) * pitch_; }
  /// x, y and z of it.
  std::array<float*, 3> lanes(int which) {
    return {array(which), array(which + 1), array(which + 2)};
  }
  LaneView view();
  int slot_of(VertexId vertex) const {
    return layout_.places[static_cast<std::size_t>(vertex)].slot;
  }
  void take_from(const State& state, double h);
  void copy_to(State& state, double h);
  MotionLanes motion();
  Vec3 position_of(const MotionLanes& motion, int slot) const;
  static Vec3 velocity_of(const MotionLanes& motion, int slot, double h);
  void set_motion(const MotionLanes& motion, int slot, const Vec3& position, const Vec3& velocity,
                  double h) const;
  /// Makes the end of a substep the start of the next, which goes on at the same velocity, and
  /// lets gravity act.
  template <bool carries>
  void predict();
  /// Notes where the solve's moves would be without constraints.
  void note_unconstrained();
  /// Makes of the velocity at the substep's start what has been added to it.
  void take_gains();
  bool stayed_behind(const Vec3& at, const Vec3& place) const;
  void place_pins(double time_end, double h);
  void find_air_drag(State& state, double h);
  void add_air_drag();
  void resolve_contacts(double h);
  void brake();
  void limit_in_double(State& state, double time_end, double h);

  LaneLayout layout_;
  std::unique_ptr<Projections> projections_;
  std::optional<DamperProgram> dampers_;   // compliant springs with dampers only
  std::optional<ContactProgram> contact_;  // models with solids only
  std::vector<VertexId> vertices_;         // one for each slot, with solids
  FreeTurns free_turns_;
  double mean_mass_;             // [kg]
  std::size_t pitch_;            // floats from one array to the next
  std::vector<float> data_;      // see Array
  Vec3 origin_{0, 0, 0};         // origin of the positions [m]
  double extent_ = 0;            // size of the cloth about it when the step starts [m]
  std::array<float, 3> fall_{};  // gravity h^2 [m]
  int substeps_left_ = 0;
  double residual_begin_ = 0, residual_end_ = 0;  // the last substep's [m]
  std::size_t n_constraints_;                     // constraints of the finest mesh
  double residual_floor_ = 0;                     // see store() [m]
  Positions pin_velocities_;                      // one column per pin [m/s]
  double time_end_ = 0;                           // end of the last substep [s]
  Positions forces_;                              // the air's [N]
  std::vector<float> air_;  // arrays as those above: to a move v it adds gain - brake v, as x y z
                            // [m] and xx yy zz xy xz yz
};

}  // namespace pleat
