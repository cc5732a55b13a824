#pragma once

#include <array>

#include "core/base/part_observer.h"

namespace pleat {

/// A clock that only moves forward [s]. In a browser its ticks may be as coarse as 0.1 ms.
class Stopwatch {
 public:
  Stopwatch();
  /// Seconds since this watch was made.
  double elapsed() const;

 private:
  double begin_;
};

/// Adds up the time spent in each part of a step. A part inside another counts for itself alone.
class PartTimer : public PartObserver {
 public:
  void begin(Part part) override;
  void end(Part part) override;

  double total(Part part) const { return totals_[static_cast<std::size_t>(part)]; }  ///< [s]
  /// Each part's share of one of `n` equal stretches of the whole, such as frames [ms].
  std::array<double, kPartCount> mean_ms(double n) const;
  void clear() { totals_.fill(0); }

 private:
  static constexpr std::size_t kMaxDepth = 4;

  void charge_running();

  Stopwatch watch_;
  double last_ = 0;  // when the running part began or was resumed [s]
  std::array<double, kPartCount> totals_{};
  std::array<Part, kMaxDepth> running_{};
  std::size_t depth_ = 0;
};

}  // namespace pleat
