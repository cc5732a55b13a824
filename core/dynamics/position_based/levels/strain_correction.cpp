#include "core/dynamics/position_based/levels/strain_correction.h"

#include <algorithm>
#include <limits>

namespace pleat {
namespace {

constexpr double kFirstShare = 0.125;  // doubled in the first cycle

/// A cycle that leaves more than this share of the squared errors has stalled.
constexpr double kStalled = 0.95;

}  // namespace

void StrainCorrection::begin() {
  last_square_ = std::numeric_limits<double>::infinity();
  least_share_ = kFirstShare;
  has_stalled_ = false;
}

// With errors e before and e' after a whole correction, a share s of it leaves |e - s (e - e')|,
// least at s = e.(e - e') / |e - e'|^2.
void StrainCorrection::correct(const GatheredSprings& springs, const float* begins, float* moves,
                               std::size_t n_numbers, const float* strains,
                               const CycleSmoothing& smoothing) {
  moves_before_.assign(moves, moves + n_numbers);
  levels_.correct(begins, moves, smoothing, strains);
  springs.strains(begins, moves, strains_after_.data());
  double square = 0, along = 0, change = 0;
  for (std::size_t i = 0; i < strains_after_.size(); ++i) {
    const double error = strains[i], mended = error - strains_after_[i];
    square += error * error;
    along += error * mended;
    change += mended * mended;
  }
  const bool stalls = !(square < kStalled * last_square_);
  has_stalled_ = has_stalled_ || stalls;
  if (stalls)
    least_share_ /= 2;
  else if (!has_stalled_)
    least_share_ = std::min(1.0, 2 * least_share_);
  last_square_ = square;
  const double best = change > 0 ? std::clamp(along / change, 0.0, 1.0) : 0;
  const auto share = static_cast<float>(std::max(best, least_share_));
  if (share == 1) return;
  for (std::size_t i = 0; i < n_numbers; ++i)
    moves[i] = moves_before_[i] + share * (moves[i] - moves_before_[i]);
}

}  // namespace pleat
