#pragma once

#include <string>
#include <string_view>

#include "cli/arguments.h"
#include "core/scene/scene_file.h"

namespace pleat {

/// The text of assets/fabrics/fabrics.json as it was when the command was built.
std::string_view embedded_fabrics();

/// The fabrics of the file after --fabrics, else the embedded ones.
FabricLibrary take_fabrics(Arguments& arguments);

/// The scene of the file that the next word names, changed by the options --level, --stepper,
/// --step, --substeps,
/// --iterations, --solver, --tolerance, --fabric, --duration and --steps. Throws InputError naming
/// the file with the JSON pointer, or the option.
Scene take_scene(Arguments& arguments);

}  // namespace pleat
