#pragma once

#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "core/scene/scene_file.h"
#include "core/scene/whole_file.h"

namespace pleat {

/// The text of assets/fabrics/fabrics.json as it was when the command was built.
std::string_view embedded_fabrics();

/// The fabrics of the file after --fabrics, else the embedded ones.
FabricLibrary take_fabrics(Arguments& arguments);

/// A scene and where its values came from.
struct SceneInput {
  Scene scene;
  std::string file;
  std::vector<std::string_view> options;  ///< that changed the scene
  bool has_duration = true;               ///< that is one, whatever the step

  bool is_set_by(std::string_view option) const;
  /// Throws InputError naming the option that set the value at fault, else the file with the JSON
  /// pointer.
  [[noreturn]] void throw_with_source(const InputError& error) const;
  /// Throws InputError that says for how many vertices.
  [[noreturn]] void throw_out_of_memory() const;
};

/// The scene of the file that the next word names, changed by the options --level, --stepper,
/// --step, --substeps, --iterations, --solver, --tolerance, --fabric, --duration and --steps.
///
/// --fabric replaces the whole fabric, but for "bending" beside a name. With another stepper than
/// the scene's, explicit gets "stable" substeps, the others one in place of "stable", and
/// projective its default solver in place of one without a factor. Throws InputError naming the
/// file with the JSON pointer, or the option.
SceneInput take_scene(Arguments& arguments);

/// Does `work` on the scene; bad input that it meets there is told with its source.
template <class Work>
auto with_source_named(const SceneInput& input, Work&& work) {
  try {
    return work();
  } catch (const FileError&) {
    throw;
  } catch (const InputError& error) {
    input.throw_with_source(error);
  } catch (const std::bad_alloc&) {
    input.throw_out_of_memory();
  }
}

}  // namespace pleat
