#pragma once

#include <limits>
#include <optional>
#include <span>

#include "core/error/bend_error.h"
#include "core/error/material_map.h"
#include "core/run/sampled_run.h"
#include "core/scene/rest_cloth.h"

namespace pleat {

/// How far a run is from another one of the same cloth, at the same times. NaN: not comparable.
struct RunErrors {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  double position = kUnknown;           ///< RMS over material points and times [m]
  double position_95 = kUnknown;        ///< mean over times of position_error_95 [m]
  double surface_rms = kUnknown;        ///< RMS over times of SurfaceError::rms [m]
  double surface_95 = kUnknown;         ///< mean over times of SurfaceError::percentile_95 [m]
  double bend_distribution = kUnknown;  ///< mean over times of BendError::distribution [1/m]
  double bend_regions = kUnknown;       ///< mean over times of BendError::regions [1/m]
};

/// Compares runs of one cloth at two levels of refinement.
///
/// Positions are compared at the vertices that both have, by area. Surfaces and curvatures need
/// triangles: of particles they are unknown, and so is curvature beyond three refinements. For it
/// the coarser run is taken to the finer mesh along mesh lines, and both are smoothed over an edge
/// of the unrefined cloth.
class RunComparison {
 public:
  /// scene            whose cloth it is, at its own level
  /// reference_level  of the run that is taken for right
  RunComparison(const Scene& scene, int reference_level);

  /// Compares runs on any two meshes of one cloth, graded ones too, at the material points that are
  /// the vertices of the reference, smoothed over the longest side of its unrefined mesh's cells:
  /// over less, facets look like error where cells are largest. Both are cloth with triangles.
  RunComparison(const Scene& scene, const Scene& reference);

  /// Throws ContractError unless both have samples at the same times.
  RunErrors errors(std::span<const Sample> run, std::span<const Sample> reference) const;

  /// Wasserstein-1 distance between the distributions of curvature over all of the times together
  /// [1/m]: what differs from time to time in two runs of one kind averages out. NaN where
  /// curvature is unknown. Throws as errors.
  double bend_over_time(std::span<const Sample> run, std::span<const Sample> reference) const;

 private:
  Positions at_common_vertices(const Positions& own) const { return map_ ? map_->of(own) : own; }
  Positions on_finer_mesh(const Positions& positions, bool is_finer) const;

  RestCloth own_;
  RestCloth reference_;
  bool own_is_finer_;
  Eigen::VectorXd areas_;                         // areas of the vertices that both have
  std::vector<std::array<VertexId, 2>> middles_;  // edges halved from a triangle mesh to the finer
  std::optional<MaterialMap> map_;  // places of the reference's vertices on its own mesh
  std::optional<BendMeasure> bend_;
};

/// Errors of position alone, at the vertices that two runs of a cloth at any two levels both have:
/// for runs that were kept without the vertices of their finest meshes.
RunErrors common_vertex_errors(const Scene& scene, std::span<const Sample> run,
                               std::span<const Sample> reference);

/// RMS distance between two such runs, for each of their samples [m].
std::vector<double> sample_distances(const Scene& scene, std::span<const Sample> run,
                                     std::span<const Sample> reference);

}  // namespace pleat
