#include "core/run/part_timer.h"

#include <chrono>

#include "core/base/check.h"

namespace pleat {
namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Stopwatch::Stopwatch() : begin_(seconds()) {}

double Stopwatch::elapsed() const { return seconds() - begin_; }

void PartTimer::charge_running() {
  const double now = watch_.elapsed();
  if (depth_ > 0) totals_[static_cast<std::size_t>(running_[depth_ - 1])] += now - last_;
  last_ = now;
}

std::array<double, kPartCount> PartTimer::mean_ms(double n) const {
  std::array<double, kPartCount> means = totals_;
  for (double& mean : means) mean *= 1e3 / n;
  return means;
}

void PartTimer::begin(Part part) {
  PLEAT_CHECK(depth_ < kMaxDepth, "parts of a step are nested at most four deep");
  charge_running();
  running_[depth_++] = part;
}

void PartTimer::end(Part part) {
  PLEAT_CHECK(depth_ > 0 && running_[depth_ - 1] == part,
              "the part that ends is the last that began");
  charge_running();
  --depth_;
}

}  // namespace pleat
