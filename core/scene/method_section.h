#pragma once

#include "core/files/json_reader.h"
#include "core/scene/scene.h"

namespace pleat {

/// The section "method" of a scene file: stepper, step and solver.
void read_method(const JsonReader& reader, MethodOptions& method);
Json json_method(const MethodOptions& method);

/// The section "record": which frames are kept, and how.
void read_record(const JsonReader& reader, RecordOptions& record);
Json json_record(const RecordOptions& record);

}  // namespace pleat
