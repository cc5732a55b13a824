#pragma once

#include "core/files/json_reader.h"
#include "core/scene/scene.h"

namespace pleat {

/// The section "garment" of a scene's cloth: measures of a skirt or of trousers for the scene's
/// figure, which has been read. Measures that make no garment are InputErrors at their places.
GarmentCloth read_garment(const JsonReader& reader, const Scene& scene);

/// The measures, from which the quads follow.
Json json_garment(const GarmentCloth& cloth);

}  // namespace pleat
