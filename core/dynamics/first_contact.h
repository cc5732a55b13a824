#pragma once

#include <functional>
#include <optional>

#include "core/dynamics/contact_memory.h"
#include "core/linalg/solve_report.h"
#include "core/model/cloth_model.h"
#include "core/model/state.h"

namespace pleat {

/// Finds when a solid first touches the cloth, and parts the substep there: cloth falls freely up
/// to the touch, and what is left of the substep ends the fall.
class FirstContact {
 public:
  /// Advances the state by h [s], to time_end.
  using Substep = std::function<SolveReport(State& state, double time_end, double h)>;

  /// model   outlives it
  /// within  the substep is parted where the nearest vertex is within this of a solid [m]; 0: no
  ///         contact is looked for
  FirstContact(ClothModel& model, double within) : model_(model), within_(within) {}

  bool is_awaited() const { return within_ > 0 && model_.contact && !time_; }
  /// Time of the touch [s]; nothing before.
  std::optional<double> time() const { return time_; }

  /// Advances by one substep, in two parts if a solid touches the cloth in it. Cloth that touches
  /// from the start of the substep takes it whole.
  SolveReport advance(const Substep& substep, State& state, ContactMemory& memory, double time_end,
                      double h);

 private:
  void keep(const State& state, const ContactMemory& memory);
  void go_back(State& state, ContactMemory& memory) const;

  ClothModel& model_;
  double within_;  // [m]
  std::optional<double> time_;
  // Kept from the start of the substep.
  State state_;
  Positions forces_;
  BendFriction::Kept friction_;
};

}  // namespace pleat
