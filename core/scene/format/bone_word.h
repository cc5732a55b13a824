#pragma once

#include "core/body/moving_body.h"
#include "core/files/json_reader.h"

namespace pleat {

/// The bone that a file names: "pelvis", "thigh_right".
Bone read_bone(const JsonReader& reader);

}  // namespace pleat
