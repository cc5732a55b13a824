// Plans of refinement for a page. Calls are as in bindings.cpp.
#include <emscripten/bind.h>

#include <optional>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/files/plan_file.h"
#include "core/run/example_study.h"
#include "wasm/arrays.h"
#include "wasm/envelope.h"
#include "wasm/handed_over.h"
#include "wasm/quad_arrays.h"

namespace {

using emscripten::val;
using pleat::guarded;
using pleat::positions_in;
using pleat::view_of;

/// Examples of one cloth on its fine mesh, and plans made of them.
class ExampleStudy {
 public:
  explicit ExampleStudy(std::string fabrics_json) : fabrics_json_(std::move(fabrics_json)) {}

  /// The scene of an example, refined uniformly: it is not run here.
  std::string open(const std::string& scene_text, const val& files) {
    return guarded([&](val& envelope) {
      const pleat::Scene scene = pleat::read_scene_with(scene_text, files, fabrics_json_);
      study_.emplace(scene);
      parents_ = pleat::quad_arrays(study_->fine()).parents;
      envelope.set("level", scene.level);
      envelope.set("n_base_vertices", study_->base().n_vertices());
      envelope.set("n_vertices", study_->fine().n_vertices());
    });
  }

  /// Four numbers for each fine vertex: the vertices whose mean it is at rest, -1 for none. Parents
  /// come before their children.
  val parents() const { return view_of(parents_); }

  /// A frame of an example; limits are of all that were added.
  std::string add_frame(const val& places) {
    return guarded([&](val&) { study().add_frame(positions_in(places)); });
  }

  /// Mean and deviation of each fine vertex's curvature over the added frames, alternating [1/m].
  val features() {
    const pleat::BendFeatures features = study().features();
    features_.assign(features.data(), features.data() + features.size());
    return view_of(features_);
  }

  /// Sorts the vertices by features as above: one example more that plans are made of.
  std::string sort(const std::string& name, const val& features, int n_patterns) {
    return guarded([&](val&) {
      const auto numbers = emscripten::convertJSArrayToNumberVector<double>(features);
      pleat::PatternOptions options;
      options.n_patterns = n_patterns;
      study().add_example(name,
                          Eigen::Map<const pleat::BendFeatures>(
                              numbers.data(), 2, static_cast<Eigen::Index>(numbers.size() / 2)),
                          options);
    });
  }

  /// `{largest_loss_m}`, `{demand}` or `{max_vertices}`, with or without `{criterion}`: the plan's
  /// file, with limits if there are frames.
  std::string plan(const std::string& options_text) {
    return guarded([&](val& envelope) {
      const val wanted = pleat::json_value(options_text);
      pleat::PlanOptions options;
      const bool has_demand = wanted["demand"].isNumber();
      const val criterion = wanted["criterion"];
      if (!criterion.isUndefined() && !criterion.equals(val("curvature")) &&
          !criterion.equals(val("shape")))
        throw pleat::InputError("/criterion", "expected shape or curvature");
      if (has_demand || criterion.equals(val("curvature")))
        options.criterion = pleat::PlanCriterion::curvature;
      if (has_demand) options.demand = wanted["demand"].as<double>();
      if (wanted["largest_loss_m"].isNumber())
        options.largest_loss = wanted["largest_loss_m"].as<double>();
      if (wanted["max_vertices"].isNumber())
        options.max_vertices = wanted["max_vertices"].as<int>();
      envelope.set("plan", pleat::json_value(pleat::plan_text(study().plan(options))));
    });
  }

 private:
  pleat::ExampleStudy& study() {
    if (!study_) throw pleat::InputError("", "expected an open example, got none");
    return *study_;
  }

  std::string fabrics_json_;
  std::optional<pleat::ExampleStudy> study_;
  std::vector<std::int32_t> parents_;
  std::vector<double> features_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(example) {
  emscripten::class_<ExampleStudy>("ExampleStudy")
      .constructor<std::string>()
      .function("open", &ExampleStudy::open)
      .function("parents", &ExampleStudy::parents)
      .function("addFrame", &ExampleStudy::add_frame)
      .function("features", &ExampleStudy::features)
      .function("sort", &ExampleStudy::sort)
      .function("plan", &ExampleStudy::plan);
}
