#pragma once

#include <span>
#include <string>

#include "core/run/run_watch.h"

namespace pleat {

/// Says each on stderr with what to try.
///
/// of  what was run, where that is not clear: a setting, an example
void tell_warnings(std::span<const RunWarning> warnings, const std::string& of = "");

}  // namespace pleat
