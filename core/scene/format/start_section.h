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
/// without velocities it is at rest.
StartState read_start(const JsonReader& reader, const FileSource& files, const Scene& scene);

/// The same, and Wavefront OBJ: its vertices, at rest. Its faces have to be the cloth's, by either
/// diagonal.
StartState read_start_or_obj(const JsonReader& reader, const FileSource& files, const Scene& scene);

/// Throws InputError{where} unless the start is of some uniform refinement of the scene's cloth,
/// and puts it to rest where it has no velocities.
StartState of_this_cloth(const std::string& where, StartState start, const Scene& scene);

Json json_start(const StartState& start);

/// Places and velocities of the start at this cloth's vertices: those that the start's mesh has too
/// are there, later ones in the mean of their parents, hanging ones in the middle of theirs.
void begin_at(const StartState& start, const Scene& scene, RestCloth& cloth);

}  // namespace pleat
