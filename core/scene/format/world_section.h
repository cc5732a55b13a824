#pragma once

#include "core/files/file_source.h"
#include "core/files/json_reader.h"
#include "core/scene/scene.h"

namespace pleat {

/// The section "pins" of a scene file. Needs scene.cloth.
void read_pins(const JsonReader& reader, Scene& scene);
Json json_pins(const Scene& scene);

/// The section "world": gravity, air, colliders. Needs scene.cloth and scene.fabric, whose friction
/// is the colliders' default.
void read_world(const JsonReader& reader, const FileSource& files, Scene& scene);
Json json_world(const Scene& scene);

}  // namespace pleat
