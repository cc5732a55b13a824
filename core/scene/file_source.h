#pragma once

#include <functional>
#include <string>

namespace pleat {

/// The bytes of a file that a scene names. Throws InputError when it cannot be had. Empty where no
/// files can be read at all.
using FileSource = std::function<std::string(const std::string& name)>;

}  // namespace pleat
