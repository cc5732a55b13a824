#include "core/run/timed_run.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/check.h"

namespace pleat {

TimedRun::TimedRun(MovingCloth& cloth, Parts parts) : cloth_(cloth), which_parts_(parts) {
  if (which_parts_ == Parts::timed) cloth_.observe(&parts_);
}

TimedRun::~TimedRun() {
  if (which_parts_ == Parts::timed) cloth_.observe(nullptr);
}

SolveReport TimedRun::step() {
  const Stopwatch watch;
  SolveReport report = cloth_.step();
  if (is_first_step_) {
    is_first_step_ = false;
    clear_costs();
  } else {
    seconds_ += watch.elapsed();
    ++n_timed_;
  }
  report_.add(report);
  return report;
}

double TimedRun::advance(std::int64_t n_steps) {
  const Stopwatch watch;
  for (std::int64_t s = 0; s < n_steps && !has_ended(); ++s) step();
  return watch.elapsed();
}

void TimedRun::clear_costs() {
  parts_.clear();
  n_timed_ = 0;
  seconds_ = 0;
}

std::int64_t steps_of_frame(double step, double frame_time) {
  constexpr double kTolerance = 1e-9;  // [s]: what a step in ten digits has
  const double n_steps = std::max(1.0, std::round(frame_time / step));
  if (!(std::abs(n_steps * step - frame_time) <= kTolerance))
    throw InputError("/method/step_s", "expected a whole part of a frame of " +
                                           std::to_string(frame_time) + " s, got " +
                                           std::to_string(step) + " s");
  return std::llround(n_steps);
}

}  // namespace pleat
