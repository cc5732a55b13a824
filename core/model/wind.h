#pragma once

#include <cstdint>
#include <vector>

#include "core/base/vec.h"

namespace pleat {

struct WindOptions {
  Vec3 velocity{0, 0, 0};  ///< mean [m/s]
  /// Standard deviation of the gusts along the mean, in shares of its speed; not negative.
  double gust_intensity = 0;
  std::uint64_t seed = 1;  ///< seed of the gusts

  bool is_still() const { return velocity.isZero(0); }
};

/// Wind that is the same all over the cloth: a mean, and gusts as a sum of sines whose frequencies
/// and phases come from a seed, so that runs repeat.
///
/// Gusts have the power spectrum of turbulence, flat up to 0.1 Hz and falling as f^(-5/3) up to
/// 5 Hz. Across the mean they are 0.80 and upward 0.52 as strong as along it. Up is y. Source:
/// Panofsky & Dutton, Atmospheric Turbulence, Wiley 1984 (neutral surface layer).
class Wind {
 public:
  explicit Wind(const WindOptions& options);

  Vec3 velocity(double time) const;  ///< velocity at a time [s], [m/s]

 private:
  struct Sine {
    Vec3 amplitude;    // [m/s]
    double frequency;  // [rad/s]
    double phase;
  };

  Vec3 mean_;
  std::vector<Sine> gusts_;
};

}  // namespace pleat
