#pragma once

namespace pleat {

/// The parts of a computation that can be timed from outside.
enum class Stage {
  convert,   ///< conversion between the shared state and a stepper's own layout
  forces,    ///< forces and right-hand side
  assembly,  ///< matrix values
  factor,    ///< numeric factorisation
  solve,     ///< linear solve or constraint projection
  contact,
  strain_limit,
};
constexpr int kStageCount = 7;

const char* name(Stage stage);

/// Told where a computation is. Nothing below `measure` reads a clock.
class StageObserver {
 public:
  virtual ~StageObserver() = default;
  virtual void begin(Stage stage) = 0;
  virtual void end(Stage stage) = 0;
};

/// Marks a stage for the length of a scope; costs one branch without an observer.
class StageScope {
 public:
  StageScope(StageObserver* observer, Stage stage) : observer_(observer), stage_(stage) {
    if (observer_) observer_->begin(stage_);
  }
  ~StageScope() {
    if (observer_) observer_->end(stage_);
  }
  StageScope(const StageScope&) = delete;
  StageScope& operator=(const StageScope&) = delete;

 private:
  StageObserver* observer_;
  Stage stage_;
};

}  // namespace pleat
