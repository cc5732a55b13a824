#include "cli/mesh_input.h"

#include "core/base/check.h"
#include "core/files/whole_file.h"

namespace pleat {

ObjMesh read_mesh(const std::string& file) {
  try {
    return read_obj(read_file(file));
  } catch (const FileError&) {
    throw;
  } catch (const InputError& error) {
    throw InputError(error.where().empty() ? file : file + ": " + error.where(), error.what());
  }
}

}  // namespace pleat
