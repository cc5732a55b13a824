#pragma once

#include <cstdint>

#include "core/run/moving_cloth.h"
#include "core/run/part_timer.h"

namespace pleat {

/// Steps a cloth and keeps its steps' reports and their cost by the clock, without that of the
/// first, in which steppers build what they keep.
class TimedRun {
 public:
  /// Timing the parts of a step costs time itself.
  enum class Parts { untimed, timed };

  /// cloth  at the start of a run; outlives this, and has no other observer where parts are
  ///        timed
  TimedRun(MovingCloth& cloth, Parts parts);
  ~TimedRun();
  TimedRun(const TimedRun&) = delete;
  TimedRun& operator=(const TimedRun&) = delete;

  /// One step, with its own report.
  SolveReport step();

  /// Makes so many steps, fewer when the numbers end the run. Returns their wall time [s], with
  /// that of a first step among them.
  double advance(std::int64_t n_steps);

  /// The numbers cannot go on.
  bool has_ended() const { return report_.ends_run(); }
  /// The reports of all steps, added up (SolveReport::add).
  const SolveReport& report() const { return report_; }
  std::int64_t n_timed() const { return n_timed_; }  ///< steps on the clock
  double seconds() const { return seconds_; }  ///< wall time of these steps, parts and all else
  const PartTimer& parts() const { return parts_; }  ///< times of their parts; zero when untimed

  /// Forgets the costs, not the report.
  void clear_costs();

 private:
  MovingCloth& cloth_;
  Parts which_parts_;
  PartTimer parts_;
  SolveReport report_;
  bool is_first_step_ = true;
  std::int64_t n_timed_ = 0;
  double seconds_ = 0;
};

/// Steps of `step` [s] that a frame of `frame_time` [s] has. Throws InputError at /method/step_s
/// unless it is a whole number of them.
std::int64_t steps_of_frame(double step, double frame_time);

}  // namespace pleat
