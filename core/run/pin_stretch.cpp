#include "core/run/pin_stretch.h"

#include <algorithm>
#include <limits>

namespace pleat {
namespace {

/// Rounding of places that one motion moves, in shares of their largest coordinate.
constexpr double kPlaceRounding = 8 * std::numeric_limits<double>::epsilon();

/// Straight through the cloth at rest there is at most the distance at rest.
double largest_over_pairs(std::span<const Pin> pins, const Positions& rest, const Positions& now) {
  double largest = 0;
  for (std::size_t a = 0; a < pins.size(); ++a)
    for (std::size_t b = a + 1; b < pins.size(); ++b) {
      const VertexId i = pins[a].vertex;
      const VertexId j = pins[b].vertex;
      const double length = (rest.col(i) - rest.col(j)).norm();
      if (length > 0) largest = std::max(largest, (now.col(i) - now.col(j)).norm() / length - 1);
    }
  return largest;
}

}  // namespace

/// True when they are the same vertices, and all went the same way since then.
bool PinStretch::moved_as_one(std::span<const Pin> pins, const Positions& now) const {
  if (pins.size() != vertices_.size()) return false;
  if (pins.empty()) return true;
  const Vec3 way = now.col(pins[0].vertex) - places_.col(0);
  const double rounding =
      kPlaceRounding * (places_.cwiseAbs().maxCoeff() + way.cwiseAbs().maxCoeff());
  for (std::size_t p = 0; p < pins.size(); ++p) {
    if (pins[p].vertex != vertices_[p]) return false;
    const Vec3 place = places_.col(static_cast<Eigen::Index>(p));
    const Vec3 apart = now.col(pins[p].vertex) - place - way;
    if (!(apart.cwiseAbs().maxCoeff() <= rounding)) return false;
  }
  return true;
}

double PinStretch::largest(std::span<const Pin> pins, const Positions& rest, const Positions& now) {
  if (moved_as_one(pins, now)) return largest_;
  vertices_.clear();
  places_.resize(3, static_cast<Eigen::Index>(pins.size()));
  for (const Pin& pin : pins) {
    places_.col(static_cast<Eigen::Index>(vertices_.size())) = now.col(pin.vertex);
    vertices_.push_back(pin.vertex);
  }
  largest_ = largest_over_pairs(pins, rest, now);
  return largest_;
}

}  // namespace pleat
