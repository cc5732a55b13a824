#pragma once

#include <array>
#include <optional>

#include "core/contact/watched_pairs.h"

namespace pleat {

/// Closest points of a pair where a substep starts, by which its sides press.
struct PairContact {
  int pair = -1;         ///< number in the list of watched pairs
  Vec3 normal{0, 0, 0};  ///< unit, from the first side to the second
  /// One for each vertex of the pair: the second side's closest point less the first's is their sum
  /// of places.
  std::array<double, 4> weights{};
  double gap = 0;     ///< distance of the sides [m]
  double wanted = 0;  ///< least distance at the end of the substep: none is pushed apart [m]
};

/// The pair's contact; nothing where its sides meet, and of edges side by side, whose ends press.
std::optional<PairContact> pair_contact(const WatchedPair& pair, int number,
                                        const Positions& begins);

/// Least gap along a normal, of all vertices of the sides.
double least_gap(const SurfacePair& pair, const Vec3& normal, const Positions& places);

}  // namespace pleat
