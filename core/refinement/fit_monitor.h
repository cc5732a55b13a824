#pragma once

#include <optional>
#include <vector>

#include "core/refinement/mesh_match.h"
#include "core/refinement/refinement_plan.h"
#include "core/refinement/vertex_curvature.h"

namespace pleat {

/// The curvature of each active face of a plan's mesh [1/m], in their order: the mean of its
/// corners'.
class FaceCurvature {
 public:
  explicit FaceCurvature(const QuadMesh& mesh);

  Eigen::VectorXd of(const PositionsView& positions) const;
  Eigen::Index n_faces() const { return static_cast<Eigen::Index>(corners_.size()); }

  /// Maximum over a face and those that touch it, from one value per face.
  Eigen::VectorXd largest_around(const VectorView& values) const;

 private:
  VertexCurvature vertices_;
  std::vector<std::array<VertexId, 4>> corners_;
  Eigen::Index n_vertices_;
};

/// The curvatures that examples reach at a plan's own spacing.
class ExampleEnvelope {
 public:
  /// mesh  of the plan
  /// fine  the mesh of the examples
  ExampleEnvelope(const QuadMesh& mesh, const QuadMesh& fine);

  /// A frame of an example: the fine mesh's positions [m].
  void add(const PositionsView& fine_positions) {
    seen_.push_back(curvature_.of(sample_.of(fine_positions)));
  }

  /// One value per active face, up to the next hundredth: the largest curvature of a face that is
  /// no more than two away from it, of which it exceeds that in one frame of 200 [1/m]. Folds come
  /// again a little beside where they were. Throws ContractError when there was no frame.
  std::vector<double> limits() const;

 private:
  MeshSample sample_;
  FaceCurvature curvature_;
  std::vector<Eigen::VectorXd> seen_;  // curvature of the faces in each frame [1/m]
};

/// How a running motion fits a plan's examples.
struct FitReport {
  double share = 0;        ///< share of the active faces that bend beyond their limit
  double worst_share = 0;  ///< the largest so far
  int n_in_a_row = 0;      ///< frames, up to this one, with too large a share
  bool fires = false;      ///< true after too many such frames
  int n_frames = 0;
  std::optional<int> first_fired;  ///< frame, counted from 0
};

/// Says when a motion is no longer of the examples' kind.
class FitMonitor {
 public:
  static constexpr double kLargestShare = 0.05;  ///< share of the active faces
  static constexpr int kFrames = 10;             ///< frames in a row beyond that fire

  /// Throws ContractError for a mesh that is not the plan's, InputError at /curvature_limits_per_m
  /// for a plan without a limit for each face.
  FitMonitor(const QuadMesh& mesh, const RefinementPlan& plan);

  /// The next frame: positions on the plan's mesh [m].
  FitReport add_frame(const PositionsView& positions);

 private:
  FaceCurvature curvature_;
  Eigen::VectorXd limits_;  // limit of each active face [1/m]
  FitReport report_;
};

}  // namespace pleat
