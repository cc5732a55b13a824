#pragma once

#include <cmath>
#include <optional>
#include <span>

#include "core/model/cloth_model.h"
#include "core/model/elasticity.h"
#include "core/model/state.h"

namespace pleat {

/// Accounts for the energy of a moving cloth from the states before and after each step alone:
/// energy that no force explains is the method's own gain or loss.
///
/// The powers of damping, air, pins and contact are integrated by the trapezoid rule over each
/// step, so that a consistent method's drift falls at least in proportion to the step, except where
/// motion jumps.
class EnergyLedger {
 public:
  /// Works done on the cloth since the start [J].
  struct Works {
    double damping = 0;
    double bend_friction = 0;  ///< minus what its law loses along the way, by its own account
    double air = 0;
    double pins = 0;
    double contact = 0;
    double cloth_contact = 0;  ///< cloth on itself, which is inelastic
    double tears = 0;

    double sum() const {
      return damping + bend_friction + air + pins + contact + cloth_contact + tears;
    }
  };

  /// model  outlives the ledger; its pins and colliders may move as their motions say, and tears
  ///        may change it (record_tear)
  /// state  at the start
  EnergyLedger(const ClothModel& model, const State& state);

  /// time_end  of the step [s];  step  its length [s], positive.
  /// on_cloth  for each vertex whether cloth pressed it in the step, whatever else did; empty where
  ///           none did
  void record(const State& begin, const State& end, double time_end, double step,
              std::span<const char> on_cloth = {});

  /// The model has become that of torn cloth; what its threads no longer store is work of the tear.
  /// state  that of the last record or of the start, on the present vertices
  void record_tear(const State& state);

  const Works& works() const { return works_; }
  const EnergyParts& parts() const { return parts_; }  ///< energies after the last step
  const EnergyParts& first_parts() const { return first_parts_; }
  double drift() const;  ///< change of the energy minus the works [J]
  /// |drift| over the largest kinetic energy seen, 0 while nothing moved.
  double relative_drift() const {
    return largest_kinetic_energy_ > 0 ? std::abs(drift()) / largest_kinetic_energy_ : 0;
  }

 private:
  /// Forces of springs, dampers, weight and air [N], and the powers of the last but one and of air
  /// [W].
  struct Loads {
    Positions forces;
    double damping_power = 0;
    double air_power = 0;
  };

  void take_vertices();
  double friction_loss() const {
    return model_.bend_friction ? model_.bend_friction->dissipated() : 0;
  }
  void exchange_friction(const State& begin);
  void evaluate(const State& state, double time, Loads& loads);
  Vec3 missing_impulse(VertexId vertex, const State& begin, const State& end, double step) const;
  void record_contact(const State& begin, const State& end, double time_end, double step,
                      std::span<const char> on_cloth);
  void record_cloth_contact(const State& begin, const State& end, double step,
                            std::span<const char> on_cloth);

  const ClothModel& model_;
  std::optional<AirDrag> air_;
  Loads begin_;
  Loads end_;
  Positions part_;  // force of one kind [N]
  std::vector<char> is_pinned_;
  std::optional<BendFriction> friction_begin_;  // moments after the last record
  double first_friction_loss_;                  // [J]
  Works works_;
  EnergyParts first_parts_;
  EnergyParts parts_;
  double largest_kinetic_energy_;
};

}  // namespace pleat
