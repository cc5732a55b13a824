#include "core/contact/separator.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/contact/closest_points.h"
#include "native-tests/support/pair_motions.h"

namespace pleat {
namespace {

PairWay way_of(const PairMotion& motion) {
  Positions begin(3, 4);
  Positions end(3, 4);
  for (int k = 0; k < 4; ++k) {
    begin.col(k) = motion.begin[k];
    end.col(k) = motion.end[k];
  }
  const std::array<VertexId, 4> v{VertexId(0), VertexId(1), VertexId(2), VertexId(3)};
  return pair_way(motion.n_first == 1 ? vertex_face_pair(v[0], {v[1], v[2], v[3]})
                                      : edge_pair({v[0], v[1]}, {v[2], v[3]}),
                  begin, end);
}

/// True where every vertex of the second side lies ahead of each of the first, without rounding.
bool lies_ahead(const Vec3& n, const std::array<Vec3, 4>& places, int n_first) {
  for (int a = 0; a < n_first; ++a)
    for (int b = n_first; b < 4; ++b)
      if (exact_side(n, places[a], places[b]) <= 0) return false;
  return true;
}

/// Three numbers of the standard normal distribution (Box & Muller).
Vec3 normal_numbers(Random& random) {
  Vec3 numbers;
  for (int i = 0; i < 3; ++i)
    numbers[i] = std::sqrt(-2 * std::log(1 - random.uniform(0, 1))) *
                 std::cos(2 * EIGEN_PI * random.uniform(0, 1));
  return numbers;
}

/// A vertex at 0.1 m above a point inside of a triangle of about a metre, on a common way of 10 m,
/// each vertex deviating by a random part of that height.
PairMotion hovering(double deviation, Random& random) {
  PairMotion motion;
  for (int k = 1; k < 4; ++k) motion.begin[k] = normal_numbers(random);
  const std::vector<double> w = random_weights(3, random);
  const Vec3 normal =
      (motion.begin[2] - motion.begin[1]).cross(motion.begin[3] - motion.begin[1]).normalized();
  motion.begin[0] =
      w[0] * motion.begin[1] + w[1] * motion.begin[2] + w[2] * motion.begin[3] + 0.1 * normal;
  const Vec3 common = 10 * normal_numbers(random);
  for (int k = 0; k < 4; ++k)
    motion.end[k] = motion.begin[k] + common + 0.1 * deviation * normal_numbers(random);
  return motion;
}

}  // namespace

TEST_CASE("separator: sides that meet never have one", "[contact]") {
  const PairFamily family =
      GENERATE(from_range(std::begin(kPairFamilies), std::end(kPairFamilies)));
  const int n_first = GENERATE(1, 2);
  CAPTURE(static_cast<int>(family), n_first);
  Random random(71);
  const int n_trials = 5600;  // a hundred thousand together
  int n_separated = 0;
  for (int trial = 0; trial < n_trials; ++trial) {
    const PairMotion motion = random_motion(family, n_first, random);
    const PairWay way = way_of(motion);
    // A needle's own normals are too rounded to decide by. One normal for the whole way that is
    // ahead at both ends is a proof.
    const int most_parts = family == PairFamily::needle ? 1 : kMostParts;
    const auto normal = separator(way, random_place(random, 1), most_parts);
    if (!normal) continue;
    ++n_separated;
    CAPTURE(trial, *normal);
    REQUIRE(lies_ahead(*normal, motion.end, n_first));
    if (family == PairFamily::needle)
      REQUIRE(lies_ahead(*normal, motion.begin, n_first));
    else
      REQUIRE_FALSE(may_meet(motion));
  }
  // Needles are mostly beyond what rounding can tell.
  if (family != PairFamily::needle) CHECK(n_separated > n_trials / 10);
  CHECK(n_separated < n_trials);
}

// An edge cannot come to pass through a triangle but by an end through the inside or by itself
// through the border.
TEST_CASE("separator: an edge that comes through a triangle lacks one with some part of it",
          "[contact]") {
  const double offset = GENERATE(0.0, 1e4);
  Random random(72);
  int n_crossing = 0;
  for (int trial = 0; trial < 8000; ++trial) {
    std::array<std::array<Vec3, 5>, 2> ends;  // the edge, then the triangle
    const double size = std::pow(10.0, random.uniform(-1.5, 0.5));
    for (int k = 0; k < 5; ++k) {
      ends[0][k] = random_place(random, 1) + Vec3::Constant(offset);
      ends[1][k] = ends[0][k] + random_place(random, size);
    }
    const auto meeting = [&](const std::array<Vec3, 5>& x) {
      return edge_and_triangle({x[0], x[1]}, {x[2], x[3], x[4]});
    };
    if (meeting(ends[0]) != Meeting::apart || meeting(ends[1]) != Meeting::crossing) continue;
    ++n_crossing;
    bool all_separated = true;
    const auto separate = [&](int n_first, const std::array<int, 4>& v) {
      PairMotion motion;
      motion.n_first = n_first;
      for (int k = 0; k < 4; ++k) {
        motion.begin[k] = ends[0][v[k]];
        motion.end[k] = ends[1][v[k]];
      }
      all_separated = all_separated && separator(way_of(motion), Vec3::Zero()).has_value();
    };
    for (const int end : {0, 1}) separate(1, {end, 2, 3, 4});
    for (const int k : {0, 1, 2}) separate(2, {0, 1, 2 + k, 2 + (k + 1) % 3});
    CAPTURE(trial);
    REQUIRE_FALSE(all_separated);
  }
  CHECK(n_crossing > 100);
}

// Sides are set along the normal to within a few roundings of touching. Scaled by a power of two
// they are as exact, but products vanish.
TEST_CASE("separator: a normal that separates does so without rounding", "[contact]") {
  const int n_first = GENERATE(1, 2);
  const double offset = GENERATE(0.0, 1.0, 1e4);
  const double scale = GENERATE(1.0, 0x1p-535);
  CAPTURE(n_first, offset, scale);
  Random random(73);
  int n_separated = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vec3 n = random_place(random, 1);
    PairMotion motion;
    motion.n_first = n_first;
    const double gap = random.uniform(-20, 20) * 0x1p-53;
    for (int k = 0; k < 4; ++k) {
      const double height = k < n_first ? 0 : gap;
      for (Vec3* place : {&motion.begin[k], &motion.end[k]}) {
        *place = random_place(random, trial % 2 == 0 ? 1 : 1e-3);
        *place += (height - n.dot(*place)) / n.squaredNorm() * n + Vec3::Constant(offset);
      }
    }
    PairMotion small = motion;
    for (auto* places : {&small.begin, &small.end})
      for (Vec3& place : *places) place *= scale;
    if (!separates(scale * n, way_of(small))) continue;
    ++n_separated;
    CAPTURE(trial, gap);
    REQUIRE(lies_ahead(n, motion.begin, n_first));
    REQUIRE(lies_ahead(n, motion.end, n_first));
  }
  if (offset == 0 && scale == 1) CHECK(n_separated > 250);
}

/// A number from 1 on whose product with a positive one is rounded up by nearly half an ulp.
double rounded_up_with(double factor, Random& random) {
  for (;;) {
    const double number = random.uniform(1, 1.02);
    const double product = number * factor;
    if (std::fma(-number, factor, product) > 0.35 * std::numeric_limits<double>::epsilon() * factor)
      return number;
  }
}

// Every difference, product and sum of n.d is rounded up by nearly as much as it can be, and d is a
// few ulps from where n.d vanishes.
TEST_CASE("separator: rounding all to one side deceives nobody", "[contact]") {
  constexpr double kUlp = std::numeric_limits<double>::epsilon();
  Random random(81);
  int n_deceiving = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    PairMotion motion;
    Vec3 corner(random.uniform(1, 1.05), random.uniform(1, 1.05), 0);
    // Less than half an ulp of the corner, so that the difference is the corner.
    const Vec3 vertex = Vec3(0.49, 0.49, 0.98) * kUlp;
    Vec3 n(rounded_up_with(corner[0], random), rounded_up_with(corner[1], random), 0);
    const double sum = n[0] * corner[0] + n[1] * corner[1];
    n[2] = random.uniform(1, 0.5 * sum);
    corner[2] = -sum / n[2];
    for (int ulps = -2; ulps <= 6; ++ulps) {
      const Vec3 raised = corner + ulps * 2 * kUlp * Vec3::UnitZ();
      motion.begin = motion.end = {vertex, raised, raised, raised};
      const bool is_ahead = exact_side(n, vertex, raised) > 0;
      n_deceiving += !is_ahead && n.dot(Vec3(raised - vertex)) > 0 ? 1 : 0;
      CAPTURE(trial, ulps);
      REQUIRE((is_ahead || !separates(n, way_of(motion))));
    }
  }
  CHECK(n_deceiving > 1000);
}

// The triangle stands: whether the vertex goes through it is one exact question. It passes the
// border by a rounding of the way that it comes from, most of which cancels in some half, quarter
// or eighth.
TEST_CASE("separator: a vertex from afar that grazes the border is not let through", "[contact]") {
  Random random(74);
  const double distance = GENERATE(1.0, 1e2, 1e4);  // [m]
  CAPTURE(distance);
  int n_crossing = 0;
  int n_separated = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    PairMotion motion;
    for (int k = 1; k < 4; ++k) motion.begin[k] = motion.end[k] = random_place(random, 0.01);
    const double share = random.uniform(0.1, 0.9);
    const Vec3 inward = (motion.begin[3] - motion.begin[1]).normalized();
    const double depth = random.uniform(-20, 20) * 0x1p-53 * distance;
    const Vec3 passed = (1 - share) * motion.begin[1] + share * motion.begin[2] + depth * inward;
    const double time = static_cast<double>(1 + random.below(7)) / 8;
    const Vec3 way = distance * random_place(random, 1).normalized();
    motion.begin[0] = passed - time * way;
    motion.end[0] = passed + (1 - time) * way;
    const bool crosses =
        edge_and_triangle({motion.begin[0], motion.end[0]},
                          {motion.begin[1], motion.begin[2], motion.begin[3]}) == Meeting::crossing;
    n_crossing += crosses ? 1 : 0;
    const bool is_separated = separator(way_of(motion), Vec3::Zero()).has_value();
    n_separated += is_separated ? 1 : 0;
    CAPTURE(trial, depth);
    REQUIRE_FALSE((crosses && is_separated));
  }
  CHECK(n_crossing > 500);
  CHECK(n_separated > 10);
}

// Differences are set ahead along a random direction, in a slab that is thin against its width.
TEST_CASE("separator: a normal that there is for the whole way is found", "[contact]") {
  const int n_first = GENERATE(1, 2);
  const double thickness = GENERATE(1.0, 1e-2, 1e-4, 1e-6);  // [m]
  CAPTURE(n_first, thickness);
  Random random(82);
  for (int trial = 0; trial < 1000; ++trial) {
    PairMotion motion;
    motion.n_first = n_first;
    const Vec3 n = random_place(random, 1).normalized();
    const Vec3 common = random_place(random, 10);
    for (int k = 0; k < 4; ++k) {
      const double side = k < n_first ? -1 : 1;
      for (Vec3* place : {&motion.begin[k], &motion.end[k]}) {
        *place = random_place(random, 1);
        *place += (side * thickness * random.uniform(0.1, 1) - n.dot(*place)) * n;
      }
      motion.end[k] += common;
    }
    CAPTURE(trial);
    REQUIRE(separates(n, way_of(motion)));
    REQUIRE(separator(way_of(motion), Vec3::Zero(), 1));
  }
}

// Closest points at the distance D along n: every point of a side deviates by at most the largest
// of its vertices, so n.(x_b - x_a) is above D - 2 g D at the end.
TEST_CASE("separator: ways that deviate by less than half of the distance always have one",
          "[contact]") {
  const PairFamily family =
      GENERATE(from_range(std::begin(kPairFamilies), std::end(kPairFamilies)));
  const int n_first = GENERATE(1, 2);
  CAPTURE(static_cast<int>(family), n_first);
  constexpr double kShare = 0.49;
  Random random(75);
  int n_near = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    PairMotion motion;
    motion.n_first = n_first;
    motion.begin = motion.end = random_pair(family, n_first, random);
    const Vec3 nearest = closest_points(way_of(motion).begins, n_first == 1 ? 3 : 4).difference;
    const double gap = nearest.norm();
    // Needles that close have no sure distance.
    if (!(gap > 1e-6) && (!is_close(family) || family == PairFamily::needle)) continue;
    ++n_near;
    const Vec3 common = random_place(random, family == PairFamily::fast ? 590.0 / 60 : 1);
    for (int k = 0; k < 4; ++k) {
      // Straight at each other, and anywhere.
      const Vec3 deviation = trial % 2 == 0 ? Vec3((k < n_first ? 1 : -1) * nearest / gap)
                                            : Vec3(random_place(random, 1).normalized());
      motion.end[k] += common + kShare * gap * deviation;
    }
    const PairWay way = way_of(motion);
    CAPTURE(trial, gap);
    REQUIRE(separates(nearest, way));
    REQUIRE(separator(way, Vec3::Zero(), 1));
  }
  if (family != PairFamily::needle) CHECK(n_near > (family == PairFamily::coplanar ? 500 : 2500));
}

TEST_CASE("separator: most motions that do not meet have one", "[contact]") {
  struct Share {
    double deviation;             ///< share of the distance [1]
    std::array<double, 4> least;  ///< found in 1, 2, 4 and 8 parts
  };
  const Share expected =
      GENERATE(Share{0.5, {0.99, 0.99, 0.99, 0.99}}, Share{2, {0.87, 0.94, 0.97, 0.985}},
               Share{5, {0.72, 0.84, 0.92, 0.96}});
  Random random(76);
  int n_apart = 0;
  std::array<int, 4> n_separated{};
  for (int trial = 0; trial < 2000; ++trial) {
    const PairMotion motion = hovering(expected.deviation, random);
    if (may_meet(motion)) continue;
    ++n_apart;
    for (int k = 0; k < 4; ++k)
      n_separated[k] += separator(way_of(motion), Vec3::Zero(), 1 << k) ? 1 : 0;
  }
  for (int k = 0; k < 4; ++k) {
    const double share = static_cast<double>(n_separated[k]) / n_apart;
    CAPTURE(expected.deviation, 1 << k, n_apart);
    CHECK(share >= expected.least[k]);
  }
}

TEST_CASE("separator: an old normal spares a search and changes no answer", "[contact]") {
  Random random(77);
  for (int trial = 0; trial < 2000; ++trial) {
    const PairMotion motion = random_motion(PairFamily::plain, 1 + trial % 2, random);
    const PairWay way = way_of(motion);
    const auto found = separator(way, Vec3::Zero());
    CAPTURE(trial);
    REQUIRE(found.has_value() == separator(way, random_place(random, 1)).has_value());
    if (!found || !separates(*found, way)) continue;
    const auto again = separator(way, 8 * *found);
    REQUIRE(again);
    REQUIRE(*again == *found);
  }
}

TEST_CASE("separator: a way common to both sides counts for nothing", "[contact]") {
  Random random(78);
  const double speed = GENERATE(1.0, 1e4);  // [m] a substep
  for (int trial = 0; trial < 2000; ++trial) {
    PairMotion motion = random_motion(PairFamily::plain, 1 + trial % 2, random);
    // Places on a grid, so that sums and differences are exact.
    for (auto* places : {&motion.begin, &motion.end})
      for (Vec3& place : *places) place = (place * 0x1p30).array().round() * 0x1p-30;
    const Vec3 common = (random_place(random, speed) * 0x1p30).array().round() * 0x1p-30;
    const auto alone = separator(way_of(motion), Vec3::Zero());
    for (Vec3& place : motion.end) place += common;
    const auto carried = separator(way_of(motion), Vec3::Zero());
    CAPTURE(trial);
    REQUIRE(alone.has_value() == carried.has_value());
    if (alone) REQUIRE(*alone == *carried);
  }
}

TEST_CASE("separator: no scale of places is too small or large", "[contact]") {
  const double scale = GENERATE(1e-50, 1e-8, 1.0, 1e8);
  CAPTURE(scale);
  Random random(79);
  int n_separated = 0;
  for (int trial = 0; trial < 300; ++trial) {
    PairMotion motion = hovering(0.2, random);
    for (auto* places : {&motion.begin, &motion.end})
      for (Vec3& place : *places) place *= scale;
    n_separated += separator(way_of(motion), Vec3::Zero()) ? 1 : 0;
  }
  CHECK(n_separated > 290);
}

TEST_CASE("separator: nothing is sure of what is not finite or where n is zero", "[contact]") {
  const double bad =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
               -std::numeric_limits<double>::infinity());
  Random random(80);
  for (int n_first = 1; n_first <= 2; ++n_first) {
    const PairMotion motion = hovering(0.1, random);
    for (int k = 0; k < 24; ++k) {
      PairMotion broken = motion;
      broken.n_first = n_first;
      (k < 12 ? broken.begin : broken.end)[k % 12 / 3][k % 3] = bad;
      CAPTURE(n_first, k);
      CHECK_FALSE(separator(way_of(broken), Vec3::UnitX()));
      for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1)})
        CHECK_FALSE(separates(n, way_of(broken)));
    }
  }
  PairMotion lifted;
  lifted.begin = lifted.end = {Vec3(0.2, 0.2, -1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  CHECK(separates({0, 0, 1}, way_of(lifted)));
  CHECK_FALSE(separates({0, 0, -1}, way_of(lifted)));
  CHECK_FALSE(separates({0, 0, 0}, way_of(lifted)));
  CHECK_FALSE(separates({0, 0, bad}, way_of(lifted)));
  CHECK_FALSE(separates({bad, 0, 1}, way_of(lifted)));
  CHECK(separator(way_of(lifted), {0, 0, bad}) == std::optional<Vec3>(Vec3(0, 0, 1)));
}

}  // namespace pleat
