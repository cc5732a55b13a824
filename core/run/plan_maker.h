#pragma once

#include <memory>
#include <vector>

#include "core/base/check.h"
#include "core/run/example_study.h"
#include "core/run/sampled_run.h"

namespace pleat {

/// Choice of the frames of an example that are analysed, and of how a plan is made of them.
struct PlanRecipe {
  double frame_time = 1.0 / 30;  ///< [s], positive
  double begin = 0;              ///< frames before are of the cloth finding its shape [s]
  PatternOptions patterns;
  PlanOptions plan;
};

/// Cost of a plan.
struct PlanCost {
  double example_seconds = 0;   ///< time of running the examples on the fine mesh, by the clock
  double planning_seconds = 0;  ///< time of features, patterns, plan and limits
  double megabytes = 0;         ///< size of the frames that were kept
  int n_frames = 0;             ///< frames of all examples
  double frame_time = 0;        ///< [s]
};

/// An example that cannot be used, and which of them.
class ExampleError : public InputError {
 public:
  ExampleError(std::size_t example, const InputError& cause)
      : InputError(cause.where(), cause.sentence()), example_(example) {}
  std::size_t example() const { return example_; }

 private:
  std::size_t example_;
};

/// When cloth has settled into the scene's motion [s]: a while after a body moves as it will.
double settled_time(const Scene& scene);

/// Runs examples on their fine mesh and plans from what is seen there, in slices.
class PlanMaker {
 public:
  /// examples  scenes of one garment or sheet refined uniformly, to the same level of at least 1
  /// Throws ExampleError when an example is none of these, has fewer than two frames or cannot run,
  /// and InputError for a recipe out of range.
  PlanMaker(std::vector<Scene> examples, const PlanRecipe& recipe);

  bool done() const { return done_; }
  /// Runs until done or `budget` [s] is spent, at least a step. Throws ExampleError for an
  /// example whose numbers end the run, and as refinement_plan and bend_patterns do.
  void advance(double budget);
  double progress() const;  ///< share done, in [0, 1]

  const RefinementPlan& plan() const { return plan_; }  ///< once done
  const PlanCost& cost() const { return cost_; }
  /// Warnings of each example that has run: signs that its scene cannot explain.
  const std::vector<std::vector<RunWarning>>& warnings() const { return warnings_; }

  /// Another plan from the same frames, once done. Throws InputError as refinement_plan does.
  RefinementPlan plan_for(const PlanOptions& options) const;

 private:
  void begin_example();
  void end_example();

  std::vector<Scene> scenes_;
  PlanRecipe recipe_;
  ExampleStudy study_;
  std::unique_ptr<SampledRun> run_;
  RefinementPlan plan_;
  PlanCost cost_;
  std::vector<std::vector<RunWarning>> warnings_;
  bool done_ = false;
};

}  // namespace pleat
