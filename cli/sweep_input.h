#pragma once

#include <map>
#include <optional>
#include <string>

#include "cli/scene_input.h"
#include "core/sweep/sweep_plan.h"

namespace pleat {

/// A plan and where its values came from.
struct SweepInput {
  SweepPlan plan;
  std::string file;                         ///< of the scene or the plan
  std::string scene_file;                   ///< that a plan's file names, or empty
  std::optional<SceneInput> scene;          ///< of a plan that options made
  std::map<std::string, const char*> grid;  ///< of such a plan: pointer and its option

  /// Files that must not be written over.
  std::vector<std::filesystem::path> files_read() const;
  /// Throws InputError naming the option that set the value at fault, else the file with the JSON
  /// pointer.
  [[noreturn]] void throw_with_source(const InputError& error) const;
  /// Throws InputError that says for how many vertices.
  [[noreturn]] void throw_out_of_memory() const;
};

/// The plan of the file that the next word names: a plan's file, or a scene's with the options
/// --set, --levels, --steppers, --repeat, --reference and those of take_scene_changes.
SweepInput take_sweep(Arguments& arguments);

}  // namespace pleat
