#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "cli/source.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/format/scene_override.h"

namespace pleat {

constexpr const char* kFabricHelp =
    R"(  --fabric NAME          in place of the scene's, with none of its own numbers
  --fabrics FILE         read the fabrics from here
)";
constexpr const char* kMethodHelp =
    R"(  --stepper NAME         in place of the scene's; settings that it does not take are left out
  --level N  --step S  --substeps N  --iterations N  --solver NAME  --tolerance X    likewise
)";
constexpr const char* kTimeHelp =
    "  --steps N | --duration S    the latter rounded to whole steps\n";

/// The text of assets/fabrics/fabrics.json as it was when the command was built.
std::string_view embedded_fabrics();

/// The fabrics of the file after --fabrics, else the embedded ones.
FabricLibrary take_fabrics(Arguments& arguments);

/// The changes to a scene that options ask for.
struct SceneChanges {
  std::vector<SceneOverride> overrides;
  std::optional<int> n_steps;                                ///< takes the place of its duration
  std::vector<std::pair<std::string, const char*>> options;  ///< JSON pointers, who sets them
};

/// A scene and where its values came from.
struct SceneInput : Source {
  Scene scene;
  Json json;  ///< the file's with the options' changes, from which the scene was read
  std::vector<std::filesystem::path> files_read;  ///< it, and those that it names
  bool is_read = false;

  std::string need() const;
};

/// Reads the files that a scene names relative to its own folder, and lists their paths in `read`,
/// which lives as long as the source.
FileSource files_beside(const std::string& scene_file, std::vector<std::filesystem::path>& read);

/// Says on stderr what a reader of cloth has to tell; nothing where that is empty.
void tell_remark(const std::string& remark);

/// A text with signs in the place of bytes that are none, as JSON takes no others.
Json text_value(const std::string& text);

/// A number where the text is one, else the text itself.
Json option_value(const std::string& text);

/// The options --level, --stepper, --step, --substeps, --iterations, --solver, --tolerance,
/// --fabric, --duration and --steps.
SceneChanges take_scene_changes(Arguments& arguments);

/// The scene of the file with these changes (override_scene). Throws InputError naming the file
/// with the JSON pointer, or the option.
SceneInput read_scene_input(const std::string& file, const SceneChanges& changes,
                            const FabricLibrary& fabrics);

/// Reads the scene that the last word names, with fabrics and changes as options say, and then the
/// others alike.
std::vector<SceneInput> take_scenes(Arguments& arguments, const std::vector<std::string>& others);
SceneInput take_scene(Arguments& arguments);

}  // namespace pleat
