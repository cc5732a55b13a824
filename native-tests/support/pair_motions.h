#pragma once

#include <array>
#include <vector>

#include "core/base/random.h"
#include "native-tests/support/exact_pairs.h"

namespace pleat {

/// Kinds of places and ways that a pair is tried in.
enum class PairFamily {
  plain,        ///< anywhere in a metre
  coplanar,     ///< all in a plane, mostly also on the way
  parallel,     ///< edges side by side, faces whose corners are in a line
  zero_length,  ///< edges and faces whose corners coincide
  tiny_gap,     ///< 1e-9 m apart, between insides
  border,       ///< 1e-9 m apart, at the border of a face, or an end of an edge
  needle,       ///< 1e-9 m apart, edges and sides of a face at sines from 1e-14 to 1e-3
  far_away,     ///< 1e4 m off
  fast,         ///< all at 590 m/s for 1/60 s, and what is left of that by rounding
};
constexpr PairFamily kPairFamilies[] = {
    PairFamily::plain,       PairFamily::coplanar, PairFamily::parallel,
    PairFamily::zero_length, PairFamily::tiny_gap, PairFamily::border,
    PairFamily::needle,      PairFamily::far_away, PairFamily::fast};

/// True for the families whose sides are 1e-9 m apart.
bool is_close(PairFamily family);

/// Uniform in a cube of this half width [m].
Vec3 random_place(Random& random, double half_width);

/// Positive weights of n corners, which sum to 1.
std::vector<double> random_weights(int n, Random& random);

/// Places of a pair's vertices [m], the first side's before the second's.
std::array<Vec3, 4> random_pair(PairFamily family, int n_first, Random& random);

/// A pair on its way. Every second one is led through itself at a random time, inside of its sides.
PairMotion random_motion(PairFamily family, int n_first, Random& random);

/// Least distance between sampled points of both sides, `n_each` along each edge [m]; it is never
/// below the true one.
double sampled_distance(const std::array<Vec3, 4>& places, int n_first, int n_each);

}  // namespace pleat
