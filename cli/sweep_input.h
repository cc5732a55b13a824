#pragma once

#include <optional>
#include <string>

#include "cli/scene_input.h"
#include "core/sweep/sweep_plan.h"

namespace pleat {

/// A plan and where its values came from: the file of a scene or of a plan, and options that made
/// the plan.
struct SweepInput : Source {
  SweepPlan plan;
  std::string scene_file;           ///< named in a plan's file, or empty
  std::optional<SceneInput> scene;  ///< read for a plan that options made

  /// Files that must not be written over.
  std::vector<std::filesystem::path> files_read() const;
  /// Throws InputError naming the option that set the value at fault, else the file with the place.
  [[noreturn]] void throw_named(const InputError& error) const;
  std::string need() const;
};

/// Reads the plan of the file that the last word names: a plan's file, or a scene's with the
/// options
/// --set, --levels, --steppers, --repeat, --reference and those of take_scene_changes.
SweepInput take_sweep(Arguments& arguments);

}  // namespace pleat
