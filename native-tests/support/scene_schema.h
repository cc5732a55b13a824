#pragma once

#include "core/dynamics/stepper_table.h"
#include "core/files/json_text.h"

namespace pleat {

/// core/scene/scene_schema.json with the steppers of a table: their names, the settings that each
/// reads, what these take, and what they are where a scene says nothing.
Json scene_schema(StepperTable steppers);

}  // namespace pleat
