#include "core/run/example_study.h"

#include "core/base/check.h"
#include "core/refinement/fit_monitor.h"
#include "core/scene/rest_cloth.h"

namespace pleat {
namespace {

QuadMesh refined_uniformly(QuadMesh mesh, int levels) {
  mesh.refine_uniformly(levels);
  return mesh;
}

}  // namespace

QuadMesh example_base(const Scene& scene) {
  std::optional<QuadMesh> base = base_quads(scene);
  if (!base)
    throw InputError("/cloth", "expected a sheet or a garment, got cloth that is not of quads");
  if (scene.plan)
    throw InputError("/refinement/plan", "expected an example refined uniformly, got a plan");
  if (scene.level < 1)
    throw InputError("/refinement/level", "expected an example refined once at least, got level 0");
  return *std::move(base);
}

ExampleStudy::ExampleStudy(const Scene& scene)
    : base_(example_base(scene)), fine_(refined_uniformly(base_, scene.level)), losses_(fine_) {}

void ExampleStudy::add_frame(Positions places) {
  if (places.cols() != fine_.n_vertices())
    throw InputError("", "expected a place for each of " + std::to_string(fine_.n_vertices()) +
                             " fine vertices, got " + std::to_string(places.cols()));
  if (!places.allFinite())
    throw InputError(
        "", "expected finite places, got others in frame " + std::to_string(frames_.size()));
  losses_.add(places);
  frames_.push_back(std::move(places));
}

BendFeatures ExampleStudy::features(std::size_t first_frame) const {
  BendFeatureSum sum(fine_);
  for (std::size_t f = first_frame; f < frames_.size(); ++f) sum.add(frames_[f]);
  return sum.features();
}

void ExampleStudy::add_example(std::string name, const BendFeatures& features,
                               const PatternOptions& options) {
  if (features.cols() != fine_.n_vertices() || !features.allFinite())
    throw InputError("features", "expected two finite numbers for each of " +
                                     std::to_string(fine_.n_vertices()) + " vertices");
  examples_.push_back({std::move(name), features, bend_patterns(features, options), {}});
  if (losses_.n_frames() > 0) examples_.back().losses = losses_.losses();
  losses_ = FaceLossSum(fine_);
}

RefinementPlan ExampleStudy::plan(const PlanOptions& options) const {
  if (examples_.empty()) throw InputError("", "expected sorted features, got none");
  for (const BendExample& example : examples_)
    if (options.criterion == PlanCriterion::shape && example.losses.size() == 0)
      throw InputError("", "expected frames of each example for the criterion \"shape\", got none");
  RefinementPlan plan = refinement_plan(base_, fine_, examples_, options);
  if (frames_.empty()) return plan;
  ExampleEnvelope envelope(planned_mesh(base_, plan), fine_);
  for (const Positions& frame : frames_) envelope.add(frame);
  plan.curvature_limits = envelope.limits();
  return plan;
}

}  // namespace pleat
