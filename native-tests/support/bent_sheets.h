#pragma once

#include "core/refinement/refinement_plan.h"
#include "native-tests/support/meshes.h"

namespace pleat {

/// Plans by the patterns at the corners of faces.
inline PlanOptions by_curvature() {
  PlanOptions options;
  options.criterion = PlanCriterion::curvature;
  return options;
}

/// A lying sheet with one fold across warp that keeps its lengths: its slope is amplitude * u
/// exp(-u^2/2), u the way along warp from `place` [m] in units of `width` [m], so that it bends by
/// amplitude / width at most [1/m].
Positions folded(const QuadMesh& mesh, double place, double amplitude, double width = 0.1);

/// Features of a fine mesh by a rule: mean and deviation at rest coordinates (u, v).
template <class Rule>
BendExample example_by_rule(const QuadMesh& fine, const Rule& rule, int n_patterns = 3) {
  BendExample example;
  example.name = "rule";
  example.features.resize(2, fine.n_vertices());
  for (int v = 0; v < fine.n_vertices(); ++v)
    example.features.col(v) = rule(fine.rest_coordinates()(0, v), fine.rest_coordinates()(1, v));
  PatternOptions options;
  options.n_patterns = n_patterns;
  example.patterns = bend_patterns(example.features, options);
  return example;
}

/// An example whose fine vertices have these patterns at the base vertices, 0 elsewhere.
BendExample example_of_patterns(const QuadMesh& fine, const std::vector<int>& base_patterns,
                                int n_patterns = 3);

}  // namespace pleat
