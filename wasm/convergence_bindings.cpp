// One step of a scene by several methods, for a page. Calls are as in bindings.cpp.
#include <emscripten/bind.h>

#include <string>

#include "core/run/convergence_json.h"
#include "core/scene/format/scene_file.h"
#include "wasm/envelope.h"

namespace {

using emscripten::val;

/// The "study" (json_convergence) of what is wished (read_convergence_options). Meanwhile
/// `on_progress` is told how much of it is done, from 0 to 1.
std::string study_convergence(const std::string& fabrics_json, const std::string& scene_text,
                              const std::string& wish_text, const val& on_progress) {
  return pleat::guarded([&](val& envelope) {
    const pleat::Scene scene = pleat::read_scene(scene_text, pleat::read_fabrics(fabrics_json));
    const pleat::Json wish = pleat::parse_json(wish_text);
    pleat::ConvergenceOptions options = pleat::read_convergence_options(pleat::JsonReader(wish));
    options.on_progress = [&](double done) { on_progress(done); };
    const pleat::Json study = pleat::json_convergence(pleat::study_convergence(scene, options));
    envelope.set("study", pleat::json_value(study.dump()));
  });
}

}  // namespace

EMSCRIPTEN_BINDINGS(pleat_convergence) {
  emscripten::function("studyConvergence", &study_convergence);
}
