#pragma once

#include <functional>
#include <string>

#include "core/base/check.h"
#include "core/files/json_reader.h"

namespace pleat {

/// The bytes of a file that a scene names. Throws InputError when it cannot be had. Empty where no
/// files can be read at all.
using FileSource = std::function<std::string(const std::string& name)>;

/// A place in a file: its name, and what is told of the place there unless that is empty.
inline std::string place_in(const std::string& file, const std::string& where) {
  return where.empty() ? file : file + ": " + where;
}

/// Result of `read` on the text of the file named at `reader`. Errors in that text are told with
/// the file's name; `files` tells itself of one that cannot be had.
template <class Read>
auto read_named_file(const JsonReader& reader, const FileSource& files, Read&& read) {
  const std::string& name = reader.text();
  if (name.empty() || name.find('\0') != std::string::npos) reader.fail("the name of a file");
  const std::string text = files(name);
  try {
    return read(text);
  } catch (const InputError& error) {
    throw InputError(place_in(name, error.where()), error.sentence());
  }
}

}  // namespace pleat
