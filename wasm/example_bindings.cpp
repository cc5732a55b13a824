// What a page plans refinement with. Calls as in bindings.cpp.
#include <emscripten/bind.h>

#include <optional>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/files/plan_file.h"
#include "core/refinement/fit_monitor.h"
#include "core/scene/rest_cloth.h"
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
      std::optional<pleat::QuadMesh> base = pleat::base_quads(scene);
      if (!base || scene.plan || scene.level < 1)
        throw pleat::InputError("/refinement",
                                "expected a sheet or garment refined uniformly, once at least");
      base_ = *base;
      fine_ = *std::move(base);
      fine_.refine_uniformly(scene.level);
      frames_.clear();
      examples_.clear();
      parents_ = pleat::quad_arrays(fine_).parents;
      envelope.set("level", scene.level);
      envelope.set("n_base_vertices", base_.n_vertices());
      envelope.set("n_vertices", fine_.n_vertices());
    });
  }

  /// Four numbers for each fine vertex: the vertices whose mean it is at rest, -1 for none. Parents
  /// come before their children.
  val parents() const { return view_of(parents_); }

  /// A frame of an example; limits are of all that were added.
  std::string add_frame(const val& places) {
    return guarded([&](val&) {
      pleat::Positions x = positions_in(places);
      if (x.cols() != fine_.n_vertices())
        throw pleat::InputError("", "expected a place for each of " +
                                        std::to_string(fine_.n_vertices()) +
                                        " fine vertices, got " + std::to_string(x.cols()));
      frames_.push_back(std::move(x));
    });
  }

  /// Mean and deviation of each fine vertex's curvature over the added frames, alternating [1/m].
  val features() {
    pleat::BendFeatureSum sum(fine_);
    for (const pleat::Positions& frame : frames_) sum.add(frame);
    const pleat::BendFeatures features = sum.features();
    features_.assign(features.data(), features.data() + features.size());
    return view_of(features_);
  }

  /// Sorts the vertices by features as above: one example more that plans are made of.
  std::string sort(const std::string& name, const val& features, int n_patterns) {
    return guarded([&](val&) {
      const auto numbers = emscripten::convertJSArrayToNumberVector<double>(features);
      const Eigen::Map<const pleat::BendFeatures> columns(
          numbers.data(), 2, static_cast<Eigen::Index>(numbers.size() / 2));
      if (columns.cols() != fine_.n_vertices() || !columns.allFinite())
        throw pleat::InputError("features", "expected two finite numbers for each of " +
                                                std::to_string(fine_.n_vertices()) + " vertices");
      pleat::PatternOptions options;
      options.n_patterns = n_patterns;
      examples_.push_back({name, columns, pleat::bend_patterns(columns, options)});
    });
  }

  /// `{demand}` or `{max_vertices}`: the plan's file, with limits if there are frames.
  std::string plan(const std::string& options_text) {
    return guarded([&](val& envelope) {
      if (examples_.empty()) throw pleat::InputError("", "expected sorted features, got none");
      const val wanted = pleat::json_value(options_text);
      pleat::PlanOptions options;
      if (wanted["demand"].isNumber()) options.demand = wanted["demand"].as<double>();
      if (wanted["max_vertices"].isNumber())
        options.max_vertices = wanted["max_vertices"].as<int>();
      pleat::RefinementPlan plan = pleat::refinement_plan(base_, fine_, examples_, options);
      if (!frames_.empty()) {
        pleat::ExampleEnvelope limits(pleat::planned_mesh(base_, plan), fine_, plan);
        for (const pleat::Positions& frame : frames_) limits.add(frame);
        plan.curvature_limits = limits.limits();
      }
      envelope.set("plan", pleat::json_value(pleat::plan_text(plan)));
    });
  }

 private:
  std::string fabrics_json_;
  pleat::QuadMesh base_;
  pleat::QuadMesh fine_;
  std::vector<pleat::BendExample> examples_;
  std::vector<pleat::Positions> frames_;
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
