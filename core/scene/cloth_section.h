#pragma once

#include "core/scene/json_reader.h"
#include "core/scene/scene.h"

namespace pleat {

/// More base vertices or particles are refused: their matrices would not fit into a browser's
/// memory.
constexpr std::int64_t kMaxVertices = 1000000;

/// Vertices of a sheet after `level` uniform refinements.
std::int64_t n_sheet_vertices(const SheetShape& shape, int level);

/// Throws InputError{where} unless the scene's cloth can be refined `level` times, 0 to kMaxLevel.
void check_level(const Scene& scene, int level, const std::string& where);

/// Vertices of the scene's cloth before refinement.
std::int64_t n_base_vertices(const Scene& scene);

/// The section "cloth" of a scene file: a sheet or particles with springs.
void read_cloth(const JsonReader& reader, Scene& scene);
Json json_cloth(const Scene& scene);

}  // namespace pleat
