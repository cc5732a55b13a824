#pragma once

#include "core/files/file_source.h"
#include "core/files/json_reader.h"
#include "core/scene/scene.h"

namespace pleat {

/// The state of a scene's "start": written out, or the name of its file. All else of the scene has
/// been read. Throws InputError for a state of another mesh.
///
/// Written out, or in a file, it is an object with "positions_m" and "velocities_m_per_s", one of
/// three numbers for each vertex of the scene's cloth after any number of uniform refinements;
/// without velocities it is at rest. A file may also be Wavefront OBJ: its vertices, at rest; its
/// faces have to be the cloth's, by either diagonal.
StartState read_start(const JsonReader& reader, const FileSource& files, const Scene& scene);

Json json_start(const StartState& start);

}  // namespace pleat
