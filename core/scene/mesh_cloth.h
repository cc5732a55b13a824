#pragma once

#include <optional>

#include "core/files/file_source.h"
#include "core/files/json_reader.h"
#include "core/scene/scene.h"

namespace pleat {

/// The section "mesh" of a scene's cloth: a mesh written out, or the name of an OBJ file.
///
/// Warp runs along the direction in which the first texture coordinate grows while the second
/// stays. Where a triangle has no texture coordinates, or they have no area, it is the direction
/// nearest to "warp_direction" in its plane, or its first side where that is perpendicular to it.
/// Lengths are those of the positions.
///
/// Faults of an OBJ file are InputErrors at "name: line N".
void read_mesh(const JsonReader& reader, const FileSource& files, Scene& scene);

/// The mesh alone; `usual_warp` takes the place of a "warp_direction" that is not there.
MeshCloth read_mesh_cloth(const JsonReader& reader, const FileSource& files,
                          const std::optional<Vec3>& usual_warp);

/// Always written out, so that the text is the whole scene.
Json json_mesh(const MeshCloth& cloth, const Vec3& initial_velocity);

}  // namespace pleat
