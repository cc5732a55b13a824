#pragma once

#include <emscripten/val.h>

#include <string>

#include "core/scene/format/scene_file.h"

namespace pleat {

/// A scene whose files are handed over as an object: the text of each by its name.
Scene read_scene_with(const std::string& scene_text, const emscripten::val& files,
                      const std::string& fabrics_json);

}  // namespace pleat
