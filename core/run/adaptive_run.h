#pragma once

#include <memory>
#include <vector>

#include "core/model/stretch.h"
#include "core/refinement/dynamic_refinement.h"
#include "core/run/scene_model.h"

namespace pleat {

/// A scene in motion whose mesh is refined and merged, frame by frame, to the shape that it has:
/// each change builds equations and stepper anew. What held vertices against solids is forgotten
/// then, for one substep.
class AdaptiveRun {
 public:
  /// scene  of a sheet or garment; it begins unrefined, whatever its level or plan
  /// Throws InputError for other cloth, options out of range and when the method cannot run on it.
  AdaptiveRun(const Scene& scene, const DynamicOptions& options);

  /// Begins a frame. Returns true when the mesh has changed. Throws InputError as
  /// make_stepper.
  bool adapt();

  /// One step of scene.method.step; see Stepper::advance.
  SolveReport step();

  /// Sets the options of later changes of the mesh.
  void set_options(const DynamicOptions& options);

  const QuadMesh& mesh() const { return *cloth_.quads; }
  const ClothModel& model() const { return *model_; }
  const State& state() const { return state_; }
  const std::vector<GaugeEdge>& gauge() const { return gauge_; }
  double time() const { return static_cast<double>(n_steps_) * scene_.method.step; }  ///< [s]
  void observe(StageObserver* observer);

 private:
  void build(RestCloth cloth);

  Scene scene_;
  QuadMesh base_;
  DynamicRefinement refinement_;
  RestCloth cloth_;
  std::unique_ptr<ClothModel> model_;
  std::vector<GaugeEdge> gauge_;
  std::unique_ptr<Stepper> stepper_;
  StageObserver* observer_ = nullptr;
  State state_;
  std::int64_t n_steps_ = 0;
};

}  // namespace pleat
