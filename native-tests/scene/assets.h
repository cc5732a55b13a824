#pragma once

#include <fstream>
#include <iterator>
#include <string>

#include "core/scene/fabric_file.h"

namespace pleat {

/// The text of a file of the repository; empty when it is missing.
inline std::string repository_file(const std::string& path) {
  std::ifstream file(std::string(PLEAT_SOURCE_DIR) + "/" + path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline const FabricLibrary& fabric_library() {
  static const FabricLibrary library = read_fabrics(repository_file("assets/fabrics/fabrics.json"));
  return library;
}

/// The scenes that come with the program.
constexpr const char* kSceneFiles[] = {"curtain",        "tablecloth",    "swinging_sheet",
                                       "corners_meet",   "falling_sheet", "hanging_chain",
                                       "spring_pendulum"};

inline std::string scene_text(const std::string& name) {
  return repository_file("assets/scenes/" + name + ".json");
}

}  // namespace pleat
