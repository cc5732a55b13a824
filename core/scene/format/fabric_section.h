#pragma once

#include "core/files/fabric_file.h"
#include "core/files/json_reader.h"
#include "core/scene/scene.h"

namespace pleat {

/// The section "fabric" of a scene file: a library fabric by name, with numbers replaced under
/// "overrides", or the scene's own numbers.
void read_fabric(const JsonReader& reader, const FabricLibrary& fabrics, Scene& scene);
Json json_fabric(const Scene& scene);

}  // namespace pleat
