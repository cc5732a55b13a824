#pragma once

namespace pleat {

/// Hash of the core's source text, made when it is built: results of different cores are never
/// taken for one another.
const char* core_version();

}  // namespace pleat
