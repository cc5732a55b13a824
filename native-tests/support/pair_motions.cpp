#include "native-tests/support/pair_motions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pleat {
namespace {

constexpr double kTinyGap = 1e-9;  // [m]

/// Difference between points inside of the two sides [m].
Vec3 inner_difference(const std::array<Vec3, 4>& places, int n_first,
                      const std::vector<double>& weights) {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 4; ++k) sum += (k < n_first ? -1 : 1) * weights[k] * places[k];
  return sum;
}

std::vector<double> weights_of_both(int n_first, Random& random) {
  std::vector<double> weights = random_weights(n_first, random);
  for (const double w : random_weights(4 - n_first, random)) weights.push_back(w);
  return weights;
}

void shift_second(std::array<Vec3, 4>& places, int n_first, const Vec3& shift) {
  for (int k = n_first; k < 4; ++k) places[k] += shift;
}

/// Moves the second side so that inner points are a tiny gap apart, along the common normal.
void bring_close(std::array<Vec3, 4>& places, int n_first, Random& random) {
  const Vec3 apart = inner_difference(places, n_first, weights_of_both(n_first, random));
  const Vec3 one = n_first == 1 ? places[2] - places[1] : places[1] - places[0];
  const Vec3 normal = one.cross(places[3] - places[n_first == 1 ? 1 : 2]).normalized();
  shift_second(places, n_first, kTinyGap * normal - apart);
}

/// Moves the second side so that it is a tiny gap off the first: a point of its first line, from
/// where it is free to go off on one side, and the first side's first vertex.
void bring_to_border(std::array<Vec3, 4>& places, int n_first, Random& random) {
  const Vec3 line_begin = places[n_first];
  const Vec3 line = places[n_first + 1] - line_begin;
  // Towards the inside of the face, or back along the other edge, differences have to grow.
  const Vec3 inside = n_first == 1 ? places[3] - places[1] : places[0] - places[1];
  Vec3 away = random_place(random, 1);
  away -= away.dot(line) / line.squaredNorm() * line;
  if (away.dot(inside) < 0) away = -away;
  const Vec3 apart = line_begin + random.uniform(0.1, 0.9) * line - places[0];
  shift_second(places, n_first, kTinyGap * away.normalized() - apart);
}

}  // namespace

bool is_close(PairFamily family) {
  return family == PairFamily::tiny_gap || family == PairFamily::border ||
         family == PairFamily::needle;
}

Vec3 random_place(Random& random, double half_width) {
  const double x = random.uniform(-half_width, half_width);
  const double y = random.uniform(-half_width, half_width);
  return {x, y, random.uniform(-half_width, half_width)};
}

std::vector<double> random_weights(int n, Random& random) {
  std::vector<double> weights;
  double sum = 0;
  for (int k = 0; k < n; ++k) sum += weights.emplace_back(random.uniform(0.1, 1));
  for (double& w : weights) w /= sum;
  return weights;
}

std::array<Vec3, 4> random_pair(PairFamily family, int n_first, Random& random) {
  std::array<Vec3, 4> places;
  for (Vec3& place : places) place = random_place(random, 0.5);
  const std::int64_t which = random.below(3);
  if (family == PairFamily::coplanar)
    for (Vec3& place : places) place.z() = 0.25;
  if (family == PairFamily::parallel || family == PairFamily::needle) {
    // Dyadic multiples of one direction: parallel to the bit where the sums are.
    const Vec3 along = n_first == 1 ? places[2] - places[1] : places[1] - places[0];
    const double factor = which == 0 ? -1 : which == 1 ? 0.5 : 2;
    places[3] = places[n_first == 1 ? 1 : 2] + factor * along;
  }
  if (family == PairFamily::needle) {
    places[3] += random_place(random, std::pow(10.0, random.uniform(-14, -3)));
    bring_close(places, n_first, random);
  }
  if (family == PairFamily::zero_length) {
    places[3] = places[2];
    if (which == 0) places[1] = places[n_first == 1 ? 2 : 0];
  }
  if (family == PairFamily::tiny_gap) bring_close(places, n_first, random);
  if (family == PairFamily::border) bring_to_border(places, n_first, random);
  if (family == PairFamily::far_away)
    for (Vec3& place : places) place += Vec3(1e4, -1e4, 1e4);
  return places;
}

PairMotion random_motion(PairFamily family, int n_first, Random& random) {
  PairMotion motion;
  motion.n_first = n_first;
  motion.begin = random_pair(family, n_first, random);
  const Vec3 common =
      family == PairFamily::fast ? random_place(random, 590.0 / 60) : random_place(random, 0.5);
  const double gap = is_close(family) ? kTinyGap : 0.3;
  const double deviation = gap * std::pow(10.0, random.uniform(-1.5, 1));
  const bool stays_flat = family == PairFamily::coplanar && random.below(4) > 0;
  for (int k = 0; k < 4; ++k) {
    Vec3 way = common + random_place(random, deviation);
    if (stays_flat) way.z() = 0;
    motion.end[k] = motion.begin[k] + way;
  }
  if (random.below(2) == 0) {
    const double time = random.uniform(0.05, 1);
    const std::vector<double> weights = weights_of_both(n_first, random);
    const Vec3 apart = (1 - time) * inner_difference(motion.begin, n_first, weights) +
                       time * inner_difference(motion.end, n_first, weights);
    shift_second(motion.end, n_first, -apart / time);
  }
  return motion;
}

double sampled_distance(const std::array<Vec3, 4>& places, int n_first, int n_each) {
  double least = std::numeric_limits<double>::infinity();
  const auto share = [&](int k) { return static_cast<double>(k) / (n_each - 1); };
  for (int i = 0; i < n_each; ++i)
    for (int j = 0; j < (n_first == 1 ? n_each - i : n_each); ++j) {
      const double s = share(i);
      const double u = share(j);
      const Vec3 difference =
          n_first == 1
              ? Vec3((1 - s - u) * places[1] + s * places[2] + u * places[3] - places[0])
              : Vec3((1 - u) * places[2] + u * places[3] - (1 - s) * places[0] - s * places[1]);
      least = std::min(least, difference.norm());
    }
  return least;
}

}  // namespace pleat
