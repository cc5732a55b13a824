#pragma once

#include <functional>
#include <string>

namespace pleat {

/// The bytes of a file that a scene names. Throws InputError when it cannot be had. Empty where no
/// files can be read at all.
using FileSource = std::function<std::string(const std::string& name)>;

/// A place in a file: its name, and what is told of the place there unless that is empty.
inline std::string place_in(const std::string& file, const std::string& where) {
  return where.empty() ? file : file + ": " + where;
}

}  // namespace pleat
