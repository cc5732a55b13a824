#include "core/model/wind.h"

#include <array>
#include <cmath>

#include "core/base/random.h"

namespace pleat {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLowest = 0.02;  // [Hz]
constexpr double kCorner = 0.1;   // corner of the spectrum [Hz]
constexpr double kHighest = 5;    // [Hz]
constexpr int kSinesPerDirection = 16;
/// Relative strengths of the gusts along the wind, across it and upward.
constexpr std::array<double, 3> kStrengths = {1, 0.80, 0.52};

/// The integral of the spectrum, which is 1 at its corner, from zero to a frequency [Hz].
double power_below(double frequency) {
  if (frequency <= kCorner) return frequency;
  return kCorner + 1.5 * kCorner * (1 - std::pow(frequency / kCorner, -2.0 / 3));
}

/// Axes along the wind, across it, and upward where the wind is level.
std::array<Vec3, 3> directions(const Vec3& velocity) {
  const Vec3 along = velocity.normalized();
  Vec3 across = along.cross(Vec3::UnitY());
  if (across.norm() < 1e-6) across = along.cross(Vec3::UnitX());
  across.normalize();
  return {along, across, across.cross(along)};
}

}  // namespace

Wind::Wind(const WindOptions& options) : mean_(options.velocity) {
  if (options.gust_intensity == 0 || options.is_still()) return;
  Random random(options.seed);
  const double deviation = options.gust_intensity * mean_.norm();
  const double all = power_below(kHighest) - power_below(kLowest);
  const double ratio = std::pow(kHighest / kLowest, 1.0 / kSinesPerDirection);
  const auto axes = directions(mean_);
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    double low = kLowest;
    for (int i = 0; i < kSinesPerDirection; ++i, low *= ratio) {
      const double power = (power_below(low * ratio) - power_below(low)) / all;
      const double amplitude = kStrengths[axis] * deviation * std::sqrt(2 * power);
      const double frequency = 2 * kPi * random.uniform(low, low * ratio);
      gusts_.push_back({amplitude * axes[axis], frequency, random.uniform(0, 2 * kPi)});
    }
  }
}

Vec3 Wind::velocity(double time) const {
  Vec3 sum = mean_;
  for (const Sine& sine : gusts_)
    sum += std::sin(sine.frequency * time + sine.phase) * sine.amplitude;
  return sum;
}

}  // namespace pleat
