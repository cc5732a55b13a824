#pragma once

#include "core/files/file_source.h"
#include "core/scene/format/scene_tables.h"
#include "core/scene/scene.h"

namespace pleat {

/// Throws InputError{where} unless the scene's cloth can be refined `level` times, 0 to kMaxLevel.
void check_level(const Scene& scene, int level, const std::string& where);

/// The section "cloth" of a scene file: one of `kinds`. The body has been read.
void read_cloth(const JsonReader& reader, const FileSource& files, std::span<const ClothKind> kinds,
                Scene& scene);
Json json_cloth(const Scene& scene);

}  // namespace pleat
