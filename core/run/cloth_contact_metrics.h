#pragma once

#include "core/dynamics/cloth_contact.h"
#include "core/files/json_reader.h"

namespace pleat {

/// Figures of self-contact since the start of a run, as metrics.json and the page have them.
Json json_cloth_contact(const ClothContact& contact);

}  // namespace pleat
