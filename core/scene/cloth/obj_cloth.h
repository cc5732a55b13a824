#pragma once

#include <optional>

#include "core/files/file_source.h"
#include "core/scene/cloth/mesh_cloth.h"

namespace pleat {

/// The section "mesh" of a scene's cloth: a mesh written out (read_written_mesh), or the name of an
/// OBJ file, whose faults are InputErrors at "name: line N".
MeshCloth read_mesh_cloth(const JsonReader& reader, const FileSource& files,
                          const std::optional<Vec3>& usual_warp = std::nullopt);

}  // namespace pleat
