#pragma once

#include <vector>

#include "core/dynamics/stepper.h"
#include "core/run/carry_over.h"

namespace pleat {

constexpr double kTransitionTime = 2;  ///< [s]

/// The way of a carried-over cloth from what the old one was to what it is itself.
///
/// It starts with the tension per width and mass of the old cloth, its drag per mass and its
/// clearance from solids. All of them go to the model's own by a smooth step over kTransitionTime.
/// Source: docs/methods/carry_over.md.
class Transition {
 public:
  /// old    the sheet whose motion is taken over
  /// fresh  the sheet that takes it, its model still its own
  Transition(const MovingSheet& old, const MovingSheet& fresh);

  /// Sets the model that the stepper works on to what it is `seconds` after the change. From
  /// kTransitionTime on that is its own, to the bit.
  void apply(double seconds, ClothModel& model, Stepper& stepper) const;

 private:
  std::vector<Spring> own_springs_;
  ContactOptions own_contact_;
  std::vector<double> rest_lengths_;  // rest lengths at the change [m]
  ContactOptions contact_;            // options at the change
  double drag_strength_;              // strength at the change
};

}  // namespace pleat
