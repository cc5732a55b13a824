#pragma once

#include <string_view>

#include "core/body/body_motion.h"
#include "core/files/file_source.h"
#include "core/files/json_reader.h"

namespace pleat {

/// Reads one of assets/motions. A channel is an array of keys, as long as every other one, or a
/// number for what stays. Throws InputError with the JSON pointer for a channel that is missing,
/// fewer than four keys, an angle beyond half a turn and anything else not as asked for.
BodyMotion read_motion(std::string_view json_text);
BodyMotion read_motion(const JsonReader& reader);

/// Written out, or the name of its file.
BodyMotion read_motion(const JsonReader& reader, const FileSource& files);

/// The motion without what its file says of sources; the same motion is read from it to the bit.
Json json_motion(const BodyMotion& motion);

}  // namespace pleat
