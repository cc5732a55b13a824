#pragma once

#include <string>
#include <string_view>

#include "cli/arguments.h"
#include "core/base/check.h"
#include "core/scene/scene_file.h"

namespace pleat {

/// The text of assets/fabrics/fabrics.json as it was when the command was built.
std::string_view embedded_fabrics();

/// The fabrics of the file after --fabrics, else the embedded ones.
FabricLibrary take_fabrics(Arguments& arguments);

struct SceneInput {
  Scene scene;
  std::string file;  ///< that it came from
};

/// The scene of the file that the next word names, changed by the options --level, --stepper,
/// --step, --substeps,
/// --iterations, --solver, --tolerance, --fabric, --duration and --steps. Throws InputError naming
/// the file with the JSON pointer, or the option.
SceneInput take_scene(Arguments& arguments);

/// Does `work`; bad input that it meets in the scene is told with the scene's file.
template <class Work>
auto with_file_named(const std::string& file, Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(file + ": " + error.where(), error.what());
  }
}

}  // namespace pleat
