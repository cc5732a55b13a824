#include "core/dynamics/pbd/error_correction.h"

#include <algorithm>
#include <limits>

namespace pleat {
namespace {

constexpr double kFirstTrust = 0.125;  // doubled in the first cycle

}  // namespace

void ErrorCorrection::begin() {
  last_square_ = std::numeric_limits<double>::infinity();
  trust_ = kFirstTrust;
}

// With errors e before and e' after a whole correction, a share s of it leaves |e - s (e - e')|,
// least at s = e.(e - e') / |e - e'|^2.
void ErrorCorrection::correct(const GatheredSprings& springs, const float* begins, float* moves,
                              std::size_t n_numbers, const CycleSmoothing& smoothing) {
  springs.strains(begins, moves, errors_.data());
  moves_before_.assign(moves, moves + n_numbers);
  levels_.correct(begins, moves, smoothing, errors_.data());
  springs.strains(begins, moves, errors_after_.data());
  double square = 0, along = 0, change = 0;
  for (std::size_t i = 0; i < errors_.size(); ++i) {
    const double error = errors_[i], mended = error - errors_after_[i];
    square += error * error;
    along += error * mended;
    change += mended * mended;
  }
  trust_ = square < last_square_ ? std::min(1.0, 2 * trust_) : 0;
  last_square_ = square;
  const double best = change > 0 ? std::clamp(along / change, 0.0, 1.0) : 0;
  const auto share = static_cast<float>(std::max(best, trust_));
  if (share == 1) return;
  for (std::size_t i = 0; i < n_numbers; ++i)
    moves[i] = moves_before_[i] + share * (moves[i] - moves_before_[i]);
}

}  // namespace pleat
