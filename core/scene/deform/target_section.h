#pragma once

#include "core/files/json_reader.h"
#include "core/scene/deform/posing_section.h"

namespace pleat {

/// The places to which a handle of a deformation takes its vertices [m]: onto a ball, with a bone,
/// or turned first and then moved.
///
/// reader   the handle
/// posing   null without a body
/// from     where they rest [m]
Positions read_targets(const JsonReader& reader, const Posing* posing, const Positions& from);

}  // namespace pleat
