#include "core/dynamics/method_options.h"

#include "core/base/check.h"
#include "core/dynamics/stepper_type.h"

namespace pleat {

void MethodOptions::validate() const {
  PLEAT_CHECK(stepper != nullptr, "a method has a stepper");
  PLEAT_CHECK(step > 0, "a step is positive");
  PLEAT_CHECK(substeps >= (stepper->has_stability_bound ? 0 : 1), "at least one substep");
  PLEAT_CHECK(iterations >= 1, "at least one iteration");
  PLEAT_CHECK(omega >= 0 && omega < 2, "an omega lies between 0 and 2");
  PLEAT_CHECK(explicit_share >= 0 && explicit_share <= 1, "a share lies between 0 and 1");
  PLEAT_CHECK(first_contact >= 0, "a distance is not negative");
  PLEAT_CHECK(carried_acceleration >= 0 && carried_acceleration <= kMostCarried,
              "less than half of an acceleration is carried");
  PLEAT_CHECK(levels >= 0, "a number of levels is not negative");
  PLEAT_CHECK(ratio > 0.1 && ratio < 0.9, "a level keeps a share between 0.1 and 0.9");
  PLEAT_CHECK(tolerance > 0 && tolerance < 1, "a relative residual lies between 0 and 1");
}

}  // namespace pleat
