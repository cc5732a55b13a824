#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "core/error/fold_spectrum.h"
#include "core/error/mesh_sampling.h"
#include "core/error/run_comparison.h"
#include "core/refinement/fit_monitor.h"
#include "core/run/adaptive_run.h"
#include "core/run/timed_run.h"

namespace pleat {

/// One of several runs of a cloth.
struct Contestant {
  Scene scene;
  std::optional<DynamicOptions> adaptive;  ///< its mesh follows its shape, frame by frame
};

struct FrameOptions {
  double frame_time = 1.0 / 30;  ///< [s], a whole number of every scene's steps
  double duration = 10;          ///< [s]
  double begin = 5;              ///< start of what is timed and compared [s]
  double settled = 2;            ///< time at which the monitors start to look [s]
  int error_every = 5;           ///< frames from one that is compared to the next

  int n_frames() const { return static_cast<int>(std::lround(duration / frame_time)); }
  /// Throws InputError naming the value that is out of range or no whole number of frames.
  void validate() const;
};

/// How a run on a plan's mesh fitted the plan's examples.
struct FitSummary {
  double outside = 0;  ///< mean share of the faces that bend beyond their limit
  FitReport last;
};

/// Vertices inside of solids, over frames.
struct Insides {
  int n_frames = 0;    ///< frames with any
  int most = 0;        ///< maximum of one frame
  double deepest = 0;  ///< [m]

  void add(const Penetration& frame);
};

/// Result of a run; times are of frames from FrameOptions::begin on.
struct ContestantResult {
  int n_vertices = 0;  ///< number of vertices; the mean over all frames of an adaptive mesh
  SolveReport report;  ///< ok, or what ended the run; residual the largest, iterations the sum
  int n_frames = 0;    ///< whole ones
  std::vector<double> frame_ms;               ///< wall time of each frame, refinement included
  std::array<double, kPartCount> parts_ms{};  ///< mean time of the parts of a frame
  std::vector<double> refinement_ms;  ///< time of each frame's refinement; empty unless adaptive
  RunErrors errors;                   ///< means over times of the distance to the first contestant
  double bend_over_time = RunErrors::kUnknown;  ///< see RunComparison [1/m]
  /// Error of the first contestant's shapes sampled on this one's mesh, root mean square over the
  /// frames that are compared: the mesh's own fault. Unknown for an adaptive mesh.
  SamplingError sampling{RunErrors::kUnknown, RunErrors::kUnknown};
  Eigen::MatrixXd folds;    ///< FoldSpectrum::amplitudes over garment_rings, of those frames [m]
  double rms_stretch = 0;   ///< mean over the frames that are compared
  double longest_edge = 0;  ///< largest l/L - 1 of all frames, 0 where all edges are shorter
  Insides all_inside;       ///< vertices inside, over all frames
  Insides unpinned_inside;  ///< vertices inside that no pin takes along
  std::optional<FitSummary> fit;  ///< fit of a mesh of a plan with limits
};

/// Runs that take turns frame by frame, so that a change of the machine's speed meets all alike.
/// The first one is what the errors of all are measured against. Looking is outside the clock.
class SideBySide {
 public:
  /// contestants  at least one, of one garment or sheet; an adaptive one's base is the first one's
  ///              and its levels are not finer
  /// Throws InputError when a scene's method cannot run on it or its step does not divide a frame.
  SideBySide(const std::vector<Contestant>& contestants, const FrameOptions& options);
  ~SideBySide();

  /// One frame of every run that has not ended.
  void advance();
  bool done() const { return frame_ == options_.n_frames(); }
  double progress() const { return static_cast<double>(frame_) / options_.n_frames(); }

  /// Call once done. Errors are NaN for runs that ended early and where the first one did.
  std::vector<ContestantResult> results() const;

 private:
  struct Run;

  FrameOptions options_;
  std::vector<std::unique_ptr<Run>> runs_;
  int frame_ = 0;
};

}  // namespace pleat
