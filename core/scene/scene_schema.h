#pragma once

#include <string_view>

#include "core/dynamics/stepper_table.h"
#include "core/files/json_text.h"

namespace pleat {

/// scene_schema.json, the JSON schema of the scene format with Pleat's own steppers.
std::string_view scene_schema_file();

/// The same with the steppers of a table: their names, the settings that each reads and what these
/// are where a scene says nothing.
Json scene_schema(StepperTable steppers);

}  // namespace pleat
