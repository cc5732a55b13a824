#pragma once

#include "core/files/file_source.h"
#include "core/files/json_reader.h"
#include "core/scene/scene.h"

namespace pleat {

/// The plan of a scene's "refinement": written out, or the name of its file. The scene's cloth
/// and model have been read. Throws InputError for a plan of another mesh, for cloth that is not
/// made of quads and for a membrane.
RefinementPlan read_scene_plan(const JsonReader& reader, const FileSource& files,
                               const Scene& scene);

}  // namespace pleat
