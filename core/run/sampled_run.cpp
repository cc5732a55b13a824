#include "core/run/sampled_run.h"

#include "core/base/check.h"
#include "core/scene/tearing.h"

namespace pleat {
namespace {

constexpr double kTimeTolerance = 1e-9;  // share of a step; sample times so near its end are at it

/// Cubic Hermite interpolation between two states `step` [s] apart; share in [0, 1].
Positions interpolated(const State& begin, const State& end, double step, double share) {
  const double s = share;
  const double s2 = s * s;
  const double s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * begin.positions + (s3 - 2 * s2 + s) * step * begin.velocities +
         (3 * s2 - 2 * s3) * end.positions + (s3 - s2) * step * end.velocities;
}

}  // namespace

SampledRun::SampledRun(const Scene& scene, std::vector<double> times, Parts parts)
    : simulation_(scene),
      run_(simulation_,
           parts == Parts::timed_with_ledger ? TimedRun::Parts::timed : TimedRun::Parts::untimed),
      times_(std::move(times)) {
  expect_whole(scene);
  PLEAT_CHECK(!times_.empty() && times_.front() > 0 && std::is_sorted(times_.begin(), times_.end()),
              "sample times are positive and ascend");
  if (parts == Parts::timed_with_ledger) ledger_.emplace(simulation_);
  if (parts != Parts::untimed) watch_.emplace(simulation_);
}

bool SampledRun::sample_is_due() const {
  const double step = simulation_.scene().method.step;
  return samples_.size() < times_.size() &&
         times_[samples_.size()] <= simulation_.time() + step * (1 + kTimeTolerance);
}

void SampledRun::take_samples(const State& begin, double time_begin) {
  const double step = simulation_.scene().method.step;
  const State& end = simulation_.state();
  while (samples_.size() < times_.size()) {
    const double time = times_[samples_.size()];
    const double share = (time - time_begin) / step;
    if (share > 1 + kTimeTolerance) return;
    Sample sample{time, {}, {}};
    sample.positions =
        share > 1 - kTimeTolerance ? end.positions : interpolated(begin, end, step, share);
    sample.stretch = stretch(simulation_.gauge(), sample.positions);
    samples_.push_back(std::move(sample));
  }
}

void SampledRun::step() {
  const double time_begin = simulation_.time();
  const bool sampling = sample_is_due();
  if (sampling) begin_ = simulation_.state();
  const SolveReport report = run_.step();
  if (report.ends_run()) return;
  if (watch_) watch_->check(simulation_, report);
  if (sampling) take_samples(begin_, time_begin);
  if (ledger_) ledger_->record_step();
  if (watch_ && done()) watch_->check_end(simulation_);
}

void SampledRun::advance(double budget) {
  const Stopwatch watch;
  while (!done()) {
    step();
    if (watch.elapsed() >= budget) return;
  }
}

}  // namespace pleat
