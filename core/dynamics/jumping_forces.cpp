#include "core/dynamics/jumping_forces.h"

#include <algorithm>
#include <string>

#include "core/base/check.h"

namespace pleat {

void refuse_jumping_forces(const ClothModel& model, const char* stepper) {
  const bool has_jumps = std::any_of(model.chord_bends.begin(), model.chord_bends.end(),
                                     [](const ChordBend& b) { return b.law == ChordLaw::arc; });
  if (has_jumps)
    throw InputError("/model/bending", std::string("expected quadratic, linear or none for ") +
                                           stepper + ", which takes no force that jumps, got arc");
}

}  // namespace pleat
