#pragma once

#include <string>

#include "core/files/fabric_file.h"

namespace pleat {

std::string repository_path(const std::string& path);

/// The text of a file of the repository; empty when it is missing.
std::string repository_file(const std::string& path);

const FabricLibrary& fabric_library();

/// The scenes that come with the program.
constexpr const char* kSceneFiles[] = {"curtain",         "tablecloth",    "swinging_sheet",
                                       "corners_meet",    "falling_sheet", "hanging_chain",
                                       "spring_pendulum", "wool",          "flag",
                                       "tearing_curtain", "swags"};

std::string scene_text(const std::string& name);

}  // namespace pleat
