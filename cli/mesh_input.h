#pragma once

#include <string>

#include "core/files/obj_file.h"

namespace pleat {

/// Throws InputError naming the file, with the line at fault where there is one.
ObjMesh read_mesh(const std::string& file);

}  // namespace pleat
