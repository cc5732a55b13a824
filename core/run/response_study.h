#pragma once

#include <optional>
#include <vector>

#include "core/scene/scene.h"

namespace pleat {

/// How far what solids did to the cloth is from what they may do: where a vertex comes down, the
/// response takes or turns its normal velocity and Coulomb's friction, of the normal change, brakes
/// the rest.
struct FrictionCheck {
  double tangential_velocity;  ///< RMS deviation over touches, in shares of the RMS before them
  double momentum;  ///< deviation at the end, in shares of the larger of what it was at first
                    ///< contact and should be then
};

/// A cloth from its first contact on, under one response.
struct ResponseRun {
  std::vector<double> normal_velocities;  ///< RMS over the vertices touched so far, after each
                                          ///< substep [m/s]
  double rms_normal_velocity = 0;         ///< RMS over all these samples [m/s]
  int n_touched = 0;                      ///< vertices
  double contact_share = 0;               ///< share of the time of a step
  /// Check of friction; none for steppers that put the forces of solids into the next substep's
  /// equations.
  std::optional<FrictionCheck> friction;
};

/// Motion of a cloth after its first contact, by the contact's effect on the normal velocity.
struct ResponseStudy {
  double first_contact = 0;  ///< [s]
  double substep = 0;        ///< [s]
  ResponseRun resting;
  ResponseRun uniform;
};

/// Runs the scene twice, from the same state at first contact, which is found to 1 um or what the
/// scene says.
///
/// window  after first contact [s], positive, at least one substep of it
/// Throws InputError for a scene without solids or with moving ones, for a method that cannot part
/// a substep at first contact, and where the scene's duration ends before contact or the window.
ResponseStudy study_response(Scene scene, double window);

}  // namespace pleat
