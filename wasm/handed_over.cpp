#include "wasm/handed_over.h"

#include "core/base/check.h"

namespace pleat {
using emscripten::val;

Scene read_scene_with(const std::string& scene_text, const val& files,
                      const std::string& fabrics_json) {
  const auto source = [&](const std::string& name) {
    const val text = files[name];
    if (!text.isString()) throw InputError(name, "expected a file handed over, got none");
    return text.as<std::string>();
  };
  return read_scene(scene_text, read_fabrics(fabrics_json), source);
}

}  // namespace pleat
