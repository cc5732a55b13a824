#pragma once

#include "core/files/json_reader.h"
#include "core/scene/scene.h"

namespace pleat {

/// The model of a scene that says nothing of it: springs where there are threads or springs to take
/// them from, a membrane for any other mesh.
ModelOptions usual_model(const Scene& scene);

/// The section "model" of a scene file: what holds the cloth together. The scene has its cloth and
/// its usual model. Refuses laws that do not go together or that this cloth cannot have.
void read_model(const JsonReader& reader, Scene& scene);
Json json_model(const ModelOptions& model);

}  // namespace pleat
