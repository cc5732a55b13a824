#pragma once

#include <string>
#include <vector>

#include "core/refinement/bend_features.h"
#include "core/refinement/refinement_plan.h"
#include "core/scene/scene.h"

namespace pleat {

/// The unrefined mesh of an example. Throws InputError for cloth that is not of quads, and for one
/// that has a plan or is not refined uniformly, once at least.
QuadMesh example_base(const Scene& scene);

/// Examples of one cloth on its fine mesh, and plans made of them.
class ExampleStudy {
 public:
  /// Throws InputError as example_base does.
  explicit ExampleStudy(const Scene& scene);

  const QuadMesh& base() const { return base_; }
  const QuadMesh& fine() const { return fine_; }

  /// A frame of the next example: the fine mesh's positions [m]. Throws InputError for another
  /// number of places and for one that is not finite.
  void add_frame(Positions places);
  const std::vector<Positions>& frames() const { return frames_; }
  /// Features of the motion from this frame on. Throws InputError as BendFeatureSum does.
  BendFeatures features(std::size_t first_frame = 0) const;

  /// Sorts the fine mesh's vertices by these features: one example more that plans are made of,
  /// with what its frames, added since the last one, lose. Throws InputError unless there are
  /// finite features for each, and as bend_patterns does.
  void add_example(std::string name, const BendFeatures& features, const PatternOptions& options);
  std::size_t n_examples() const { return examples_.size(); }

  /// The plan has limits when there are frames, taken from all of them. Throws InputError without
  /// an example, for PlanCriterion::shape and an example without frames, and as refinement_plan
  /// does.
  RefinementPlan plan(const PlanOptions& options) const;

 private:
  QuadMesh base_;
  QuadMesh fine_;
  std::vector<BendExample> examples_;
  std::vector<Positions> frames_;
  FaceLossSum losses_;  // losses in the next example's frames
};

}  // namespace pleat
