#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "cli/arguments.h"
#include "core/files/obj_file.h"
#include "core/modal/modal_body.h"

namespace pleat {

constexpr const char* kCompletionHelp =
    R"(  --volume lattice|shell that carries the surface (default: a lattice in a closed one, else a shell)
  --size S               edge of the lattice or thickness of the shell [m]
  --modes N              of each key, beside the rigid motions (default 40)
  --functions N --clusters N   of the space of shapes (default 64 and 64)
  --exact-keys           the keys themselves are in the space
  --detail-beyond D      patches that the space meets to D [m] have no detail of their own
)";

/// Surfaces with the same vertices and triangles, each from an OBJ file.
struct KeySurfaces {
  std::vector<std::filesystem::path> files;
  std::vector<Positions> positions;  ///< [m]
  ObjMesh mesh;                      ///< the first
};

/// Reads the files of all words that are left. Throws InputError for files of different triangles.
KeySurfaces take_keys(Arguments& arguments);

/// --modes N.
std::optional<int> take_mode_count(Arguments& arguments);

/// --volume lattice|shell and --size S.
ModalOptions take_volume_options(Arguments& arguments);

/// All of these, and --functions N, --clusters N, --exact-keys and --detail-beyond D.
ModalOptions take_completion_options(Arguments& arguments);

}  // namespace pleat
