#include "cli/source.h"

#include <algorithm>

namespace pleat {

bool Source::is_set_by(std::string_view option) const {
  return std::any_of(options.begin(), options.end(),
                     [&](const auto& entry) { return entry.second == option; });
}

void Source::throw_named(const InputError& error) const {
  const std::string& where = error.where();
  for (const auto& [pointer, option] : options) {
    // The numbers of a fabric come with its name.
    const bool is_there = where == pointer || where + "/name" == pointer;
    if (is_there || where.rfind(pointer + "/", 0) == 0) throw InputError(option, error.sentence());
  }
  if (where.empty()) throw InputError(file, error.sentence());
  const bool is_named = where.rfind(file, 0) == 0 || where.rfind("--", 0) == 0;
  throw InputError(is_named ? where : file + ": " + where, error.sentence());
}

ObjMesh read_mesh(const std::string& file) {
  return with_source_named(Source{file}, [&] { return read_obj(read_file(file)); });
}

}  // namespace pleat
