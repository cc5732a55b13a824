#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "native-tests/support/pleat_command.h"

namespace pleat {

/// A sheet of nine vertices, hung by its upper edge for 0.2 s.
extern const char* const kSmallScene;
/// A triangle that each step throws back faster than it came.
extern const char* const kWildScene;

/// kSmallScene with a part of its text replaced.
std::string scene_with(const std::string& from, const std::string& to);

/// A folder with a scene in it.
struct SmallScene {
  ScratchFolder folder;
  std::string file = (folder / "scene.json").string();
  explicit SmallScene(const std::string& text = kSmallScene);

  /// The command with the scene as its first word's own.
  Ending run(std::vector<std::string> words) const;
};

/// Every file below a folder and what is in it.
std::map<std::string, std::string> contents(const std::filesystem::path& folder);

std::ptrdiff_t n_lines(const std::string& text);

}  // namespace pleat
