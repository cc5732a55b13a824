#pragma once

#include "core/model/cloth_model.h"

namespace pleat {

/// Throws InputError at /model/bending for a model with a force that jumps where cloth is straight,
/// as that of ChordLaw::arc: what holds a force over a substep, or solves for its end, is thrown to
/// and fro across the jump and never comes to rest.
///
/// stepper  its name, for the sentence
void refuse_jumping_forces(const ClothModel& model, const char* stepper);

}  // namespace pleat
