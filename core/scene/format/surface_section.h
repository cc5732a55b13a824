#pragma once

#include <vector>

#include "core/files/file_source.h"
#include "core/scene/surface_solid.h"

namespace pleat {

/// Keys of a collider that name a solid by its surface.
std::vector<const char*> surface_words();

/// The solid of that word that a collider names: its shape alone. A mesh is written out, or the
/// name of an OBJ file. Throws InputError for a box without a size, and for a mesh that does not
/// close, is not wound alike or passes through itself, with the place.
SurfaceSolid read_surface(const JsonReader& collider, const char* word, const FileSource& files);

/// Its word, and what stands there: a mesh is always written out, so that the text is the whole
/// scene.
const char* word_for(const SurfaceSolid& solid);
Json json_shape(const SurfaceSolid& solid);

}  // namespace pleat
