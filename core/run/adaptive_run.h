#pragma once

#include <memory>
#include <vector>

#include "core/refinement/dynamic_refinement.h"
#include "core/run/moving_cloth.h"
#include "core/run/scene_model.h"

namespace pleat {

/// A scene in motion whose mesh is refined and merged, frame by frame, to the shape that it has:
/// each change builds equations and stepper anew. What held vertices against solids is forgotten
/// then, for one substep.
class AdaptiveRun final : public MovingCloth {
 public:
  /// scene  of a sheet or garment; it begins unrefined, whatever its level or plan
  /// Throws InputError for other cloth, cloth that tears, options out of range and when the method
  /// cannot run on it.
  AdaptiveRun(const Scene& scene, const DynamicOptions& options);

  /// Begins a frame. Returns true when the mesh has changed. Throws InputError as
  /// make_stepper.
  bool adapt();

  SolveReport step() override;

  /// Sets the options of later changes of the mesh.
  void set_options(const DynamicOptions& options) {
    refinement_ = DynamicRefinement(base_, options);
  }

  const QuadMesh* mesh() const override { return &*cloth_.quads; }
  const ClothModel& model() const override { return *model_; }
  const State& state() const override { return state_; }
  const std::vector<GaugeEdge>& gauge() const override { return gauge_; }
  double time() const override { return static_cast<double>(n_steps_) * scene_.method.step; }
  void observe(PartObserver* observer) override;

 private:
  void build(RestCloth cloth);

  Scene scene_;
  QuadMesh base_;
  DynamicRefinement refinement_;
  RestCloth cloth_;
  std::unique_ptr<ClothModel> model_;
  std::vector<GaugeEdge> gauge_;
  std::unique_ptr<Stepper> stepper_;
  PartObserver* observer_ = nullptr;
  State state_;
  std::int64_t n_steps_ = 0;
};

}  // namespace pleat
