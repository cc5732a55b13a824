// Sweeps of speed and error for a page. Calls are as in bindings.cpp.
#include <emscripten/bind.h>

#include <optional>
#include <string>

#include "core/base/check.h"
#include "core/base/core_version.h"
#include "core/scene/format/scene_file.h"
#include "core/sweep/sweep.h"
#include "wasm/envelope.h"

namespace {

using emscripten::val;
using pleat::guarded;

/// A sweep on the visitor's machine, in slices short enough to show progress and to give up between
/// them.
class Experiment {
 public:
  explicit Experiment(std::string fabrics_json) : fabrics_json_(std::move(fabrics_json)) {}

  /// Answers with the ids of the references that rows are compared with. Those that are kept by the
  /// first `advance` are not made.
  std::string start(const std::string& plan_text) {
    return guarded([&](val& envelope) {
      const pleat::FabricLibrary fabrics = pleat::read_fabrics(fabrics_json_);
      const auto read = [fabrics](const pleat::JsonReader& scene) {
        return pleat::read_scene(scene, fabrics);
      };
      const pleat::Json plan = pleat::parse_json(plan_text);
      sweep_.emplace(pleat::read_sweep_plan(pleat::JsonReader(plan), read), references_,
                     pleat::core_version());
      envelope.set("references", pleat::json_array(sweep_->reference_ids()));
    });
  }

  std::string keep_reference(const std::string& bytes) {
    return guarded([&](val&) { references_.keep(pleat::read_reference(bytes)); });
  }

  std::string advance(double budget_ms) {
    return guarded([&](val& envelope) {
      if (!sweep_) throw pleat::InputError("", "expected a started experiment, got none");
      sweep_->advance(1e-3 * budget_ms);
      const val report = pleat::json_value(sweep_->report().dump());
      for (const char* key : {"done", "progress", "estimated_s", "rows", "front", "message"})
        envelope.set(key, report[key]);
    });
  }

 private:
  std::string fabrics_json_;
  pleat::MemoryReferenceStore references_;
  std::optional<pleat::Sweep> sweep_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(pleat_sweep) {
  emscripten::class_<Experiment>("Experiment")
      .constructor<std::string>()
      .function("start", &Experiment::start)
      .function("keepReference", &Experiment::keep_reference)
      .function("advance", &Experiment::advance);
}
