#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "core/base/check.h"
#include "core/files/json_text.h"
#include "core/scene/deform/deform_scene.h"

namespace pleat {

/// A deformation and where its values came from.
struct DeformInput {
  DeformScene scene;
  FabricLibrary fabrics;
  std::string file;
  std::vector<std::filesystem::path> files_read;  ///< it, and those that it names
  /// Pointers to what options have set, with the options.
  std::vector<std::pair<std::string, const char*>> sources;

  /// Throws InputError naming the option that set the value at fault, else the file with the JSON
  /// pointer.
  [[noreturn]] void throw_with_source(const InputError& error) const;
  [[noreturn]] void throw_out_of_memory() const;
};

/// Weights, measures or terms.
template <class Three>
Json json_three(const Three& numbers) {
  return {
      {"recovery", numbers.recovery}, {"stretch", numbers.stretch}, {"bending", numbers.bending}};
}

/// The scene or mesh that the next word names, with the options --fabrics, --fabric, --measure,
/// --weights, --form, --terms, --pin and --handle.
DeformInput take_deform_scene(Arguments& arguments);

}  // namespace pleat
