#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/quad_mesh.h"
#include "core/refinement/bend_patterns.h"
#include "core/refinement/face_losses.h"

namespace pleat {

/// A motion of the fine mesh, analysed.
struct BendExample {
  std::string name;
  BendFeatures features;  ///< features of the fine mesh's vertices [1/m]
  BendPatterns patterns;
  FaceLosses losses;  ///< losses of the fine mesh's faces; only PlanCriterion::shape reads them
};

/// Measure by which faces are split.
enum class PlanCriterion {
  shape,      ///< loss of the example's shapes
  curvature,  ///< the patterns of their corners
};

/// Bound on the allowed loss [m]: cloth in folds has lost its shape long before.
constexpr double kLargestLossEnd = 0.1;

struct PlanOptions {
  PlanCriterion criterion = PlanCriterion::shape;
  /// Allowed loss of `shape`, root mean square over the cloth and the frames of any example [m].
  /// Range from 0, which splits all, to below kLargestLossEnd.
  double largest_loss = 0.002;
  /// Threshold of `curvature`: a face is split where the demands of its corners sum to more; lower,
  /// more vertices. From 0 to below 4 (number of patterns - 1).
  double demand = 3;
  /// Largest number of vertices, in place of either; as many as possible are made.
  std::optional<int> max_vertices;
  std::optional<int> level_cap;  ///< finest level; else that of the fine mesh, which is the most
};

/// Throws InputError naming the demand, vertex budget or level cap that is out of range;
/// `max_level` is the fine mesh's.
void check_plan_options(const PlanOptions& options, int n_patterns, const QuadMesh& base,
                        int max_level);

/// The part of an example that a plan keeps.
struct PlanExample {
  std::string name;
  BendFeatures centres;        ///< a column for each pattern [1/m]
  Eigen::Vector2d low{0, 0};   ///< features that clustering maps to 0 [1/m]
  Eigen::Vector2d high{1, 1};  ///< features that clustering maps to 1 [1/m]
};

/// A split of a plan, and the reason for it.
struct PlannedSplit {
  FaceId face;
  /// Sum of its corners' demands when it was split; with PlanCriterion::shape its loss, root mean
  /// square [m].
  double demand = 0;
  bool for_balance = false;  ///< only because a neighbour needed it
};

/// The splits of a base mesh, built once from examples and used for every motion of their kind.
struct RefinementPlan {
  std::vector<PlanExample> examples;
  int n_patterns = 3;
  std::vector<int> patterns;         ///< pattern of each base vertex, from 0, the calmest
  PlanOptions options;               ///< options with the level cap
  std::vector<PlannedSplit> splits;  ///< splits in the order in which they make the mesh
  int n_vertices = 0;                ///< number of vertices of the planned mesh
  std::uint64_t base_mesh = 0;       ///< its fingerprint
  /// Mean curvature of a face's corners that the examples hardly exceeded thereabouts, one value
  /// per face that is not split, ExampleEnvelope::limits [1/m]; empty while these were not
  /// measured.
  std::vector<double> curvature_limits;
};

/// Plans where to split. A base vertex has the highest pattern that an example gives it.
///
/// By shape: shape_splits, a face's loss the largest that an example has.
///
/// By curvature and demand: demands begin as patterns. In each pass every face is split whose
/// corners sum to more than options.demand; a vertex that was there then demands one less, at least
/// 0, and a new one the mean of its parents. By curvature and number: one face after another with
/// what balance needs, first the one with the largest sum of max(demand - level, 0), demands
/// staying as they begin, then with the largest mean curvature of the example, then the first;
/// faces that would exceed the number are left out.
///
/// base      not refined
/// fine      base refined uniformly
/// examples  at least one, all with as many patterns
/// Throws InputError as check_plan_options does.
/// Source: the multi-resolution quad cloth listed as M in docs/reproduction.md, for curvature;
/// docs/methods/multiresolution.md.
RefinementPlan refinement_plan(const QuadMesh& base, const QuadMesh& fine,
                               std::span<const BendExample> examples,
                               const PlanOptions& options = {});

/// The mesh of a plan. Throws InputError for a plan of another mesh, and at /splits for one whose
/// splits do not make a mesh of its own number of vertices.
QuadMesh planned_mesh(const QuadMesh& base, const RefinementPlan& plan);

}  // namespace pleat
