#pragma once

#include <string>
#include <string_view>

#include "core/scene/fabric_file.h"
#include "core/scene/scene.h"

namespace pleat {

/// Reads a scene (JSON, schema in scene_schema.json). Unknown keys, wrong types, values out of
/// range and everything that could not run throw InputError with the JSON pointer, what was
/// expected and what was found.
Scene read_scene(std::string_view json_text, const FabricLibrary& fabrics);

/// The same scene with every default written out. read_scene(write_scene(s)) gives s again.
std::string write_scene(const Scene& scene);

/// The JSON schema of the format, as text.
std::string_view scene_schema();

}  // namespace pleat
