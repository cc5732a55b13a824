#pragma once

#include <span>
#include <string>

#include "core/dynamics/stepper_table.h"
#include "core/files/json_text.h"

namespace pleat {

/// A value that takes the place of one in a scene's file.
struct SceneOverride {
  std::string pointer;  ///< JSON pointer into the scene (RFC 6901), such as "/method/substeps"
  Json value;
};

/// Sets values in a scene as its file has it: whoever reads it then checks them like the file's.
///
/// A section is set before what is in it, "/method/stepper" and "/fabric/name" before their
/// neighbours, all else in the order given. Objects that are missing on the way are made. Another
/// stepper than the scene's leaves out all settings of "method" but "step_s", so that it takes its
/// usual ones where nothing else is set. A solver leaves out what is of no effect beside it.
/// Another fabric's name leaves out the scene's own numbers, but for "bending" beside a name.
///
/// A value that is no object though it should be is left to the scene's reader to refuse. Throws
/// InputError{pointer} for text that is no pointer and for an element that an array does not have.
void override_scene(Json& scene, std::span<const SceneOverride> overrides,
                    StepperTable steppers = standard_steppers());

}  // namespace pleat
