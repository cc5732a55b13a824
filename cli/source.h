#pragma once

#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/files/obj_file.h"
#include "core/files/whole_file.h"

namespace pleat {

/// A file that is read and what options set in it, for sentences that say where bad input is.
struct Source {
  std::string file;
  std::vector<std::pair<std::string, const char*>> options = {};  ///< JSON pointers, who sets them

  bool is_set_by(std::string_view option) const;
  /// Throws InputError naming the option that set the value at fault or one that it is in, else the
  /// file with the place in it.
  [[noreturn]] void throw_named(const InputError& error) const;
  /// Says for what memory is needed.
  std::string need() const { return "to read it"; }
};

/// Does `work` on what was or is read from a source; bad input that it meets is told with it.
template <class Input, class Work>
auto with_source_named(const Input& input, Work&& work) {
  try {
    return work();
  } catch (const FileError&) {
    throw;
  } catch (const InputError& error) {
    input.throw_named(error);
  } catch (const std::bad_alloc&) {
    throw InputError(input.file, "not enough memory " + input.need());
  }
}

/// Throws InputError naming the file, with the line at fault where there is one.
ObjMesh read_mesh(const std::string& file);

}  // namespace pleat
