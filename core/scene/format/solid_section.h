#pragma once

#include <vector>

#include "core/contact/solid_shape.h"
#include "core/files/json_reader.h"

namespace pleat {

/// Keys of a collider that name its solid, of which it has exactly one.
std::vector<const char*> solid_words();

/// The solid that a collider names.
SolidShape read_solid(const JsonReader& collider);

/// Its word, and what stands there. Throws ContractError for a limb that no scene can name.
const char* word_for(const SolidShape& shape);
Json json_solid(const SolidShape& shape);

}  // namespace pleat
