#pragma once

#include "core/files/file_source.h"
#include "core/files/json_reader.h"
#include "core/scene/scene.h"

namespace pleat {

/// Vertices of the scene's cloth after `level` uniform refinements; particles have none.
std::int64_t n_refined_vertices(const Scene& scene, int level);

/// Throws InputError{where} unless the scene's cloth can be refined `level` times, 0 to kMaxLevel.
void check_level(const Scene& scene, int level, const std::string& where);

/// The section "cloth" of a scene file: a sheet, particles with springs, a mesh
/// or a garment for the figure, which has been read.
void read_cloth(const JsonReader& reader, const FileSource& files, Scene& scene);
Json json_cloth(const Scene& scene);

}  // namespace pleat
