#include "core/contact/closest_points.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/contact/surface_pair.h"
#include "native-tests/support/pair_motions.h"

namespace pleat {
namespace {

Positions columns(const std::array<Vec3, 4>& places) {
  Positions positions(3, 4);
  for (int k = 0; k < 4; ++k) positions.col(k) = places[k];
  return positions;
}

SurfacePair pair_of(int n_first) {
  if (n_first == 1) return vertex_face_pair(VertexId(0), {VertexId(1), VertexId(2), VertexId(3)});
  return edge_pair({VertexId(0), VertexId(1)}, {VertexId(2), VertexId(3)});
}

ClosestPoints closest_of(const std::array<Vec3, 4>& places, int n_first) {
  const SurfacePair pair = pair_of(n_first);
  return closest_points(pair_differences(pair, columns(places)), pair.n_differences());
}

Vec3 weighted(const std::array<Vec3, 4>& places, int n_first, const std::array<double, 4>& w) {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 4; ++k) sum += (k < n_first ? -1 : 1) * w[k] * places[k];
  return sum;
}

}  // namespace

// A point of a convex set is its nearest to zero if and only if no corner lies nearer along it.
TEST_CASE("closest points: no corner lies nearer along their difference", "[contact]") {
  const PairFamily family =
      GENERATE(from_range(std::begin(kPairFamilies), std::end(kPairFamilies)));
  const int n_first = GENERATE(1, 2);
  CAPTURE(static_cast<int>(family), n_first);
  Random random(61);
  for (int trial = 0; trial < 3000; ++trial) {
    const std::array<Vec3, 4> places = random_pair(family, n_first, random);
    const Vec3 found = closest_of(places, n_first).difference;
    CAPTURE(trial, found);
    double least = std::numeric_limits<double>::infinity();
    for (int a = 0; a < n_first; ++a)
      for (int b = n_first; b < 4; ++b) least = std::min(least, found.dot(places[b] - places[a]));
    // Only needles, of up to 3 m, err by more than rounding.
    const double slack = family == PairFamily::needle ? 1e-7 : 1e-12;
    REQUIRE(least >= found.squaredNorm() - slack * found.norm());
  }
}

TEST_CASE("closest points: no other two of ten thousand are nearer", "[contact]") {
  const PairFamily family =
      GENERATE(from_range(std::begin(kPairFamilies), std::end(kPairFamilies)));
  const int n_first = GENERATE(1, 2);
  CAPTURE(static_cast<int>(family), n_first);
  Random random(62);
  for (int trial = 0; trial < 40; ++trial) {
    const std::array<Vec3, 4> places = random_pair(family, n_first, random);
    const double found = closest_of(places, n_first).difference.norm();
    const double sampled = sampled_distance(places, n_first, n_first == 1 ? 141 : 100);
    CAPTURE(trial);
    REQUIRE(found <= sampled + (family == PairFamily::needle ? 1e-7 : 1e-12));
    // No edge is longer than 4 m, and no point further than half of a part from a sample.
    REQUIRE(found >= sampled - 4.0 / 99);
  }
}

TEST_CASE("closest points: weights are shares of both sides and give the difference", "[contact]") {
  const PairFamily family =
      GENERATE(from_range(std::begin(kPairFamilies), std::end(kPairFamilies)));
  const int n_first = GENERATE(1, 2);
  CAPTURE(static_cast<int>(family), n_first);
  Random random(63);
  // Places are known to an ulp of themselves.
  const double rounding = family == PairFamily::far_away ? 1e-10 : 1e-12;
  int n_inside = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const std::array<Vec3, 4> places = random_pair(family, n_first, random);
    const ClosestPoints closest = closest_of(places, n_first);
    const auto& w = closest.weights;
    CAPTURE(trial, w[0], w[1], w[2], w[3]);
    for (const double weight : w) REQUIRE((weight >= 0 && weight <= 1));
    const double first = n_first == 1 ? w[0] : w[0] + w[1];
    REQUIRE(first == Approx(1).epsilon(1e-15));
    REQUIRE(w[0] + w[1] + w[2] + w[3] == Approx(2).epsilon(1e-15));
    // Needles amplify rounding by the reciprocal of their sine.
    const Vec3 one = n_first == 1 ? places[2] - places[1] : places[1] - places[0];
    const Vec3 other = places[3] - places[n_first == 1 ? 1 : 2];
    const double sine = one.cross(other).norm() / (one.norm() * other.norm());
    const double amplified = sine > 0 ? rounding / std::max(sine, 1e-8) : rounding;
    REQUIRE((weighted(places, n_first, w) - closest.difference).norm() < amplified);
    n_inside += w[0] * w[1] * w[2] * w[3] > 0 ? 1 : 0;
  }
  if (family == PairFamily::tiny_gap) CHECK(n_inside > 2900);
  if (family == PairFamily::plain) CHECK((n_inside > 100 && n_inside < 2900));
}

// Where edges run nearly side by side, the nearest difference moves by as much as the root of what
// is rounded.
TEST_CASE("closest points: sides and corners in another order have the same difference",
          "[contact]") {
  const PairFamily family =
      GENERATE(from_range(std::begin(kPairFamilies), std::end(kPairFamilies)));
  CAPTURE(static_cast<int>(family));
  constexpr double kSlack = 1e-7;  // [m]
  Random random(64);
  for (int trial = 0; trial < 1000; ++trial) {
    CAPTURE(trial);
    const auto e = random_pair(family, 2, random);
    const Vec3 of_edges = closest_of(e, 2).difference;
    CHECK((closest_of({e[2], e[3], e[0], e[1]}, 2).difference + of_edges).norm() < kSlack);
    CHECK((closest_of({e[1], e[0], e[2], e[3]}, 2).difference - of_edges).norm() < kSlack);
    const auto f = random_pair(family, 1, random);
    const Vec3 of_face = closest_of(f, 1).difference;
    CHECK((closest_of({f[0], f[2], f[3], f[1]}, 1).difference - of_face).norm() < kSlack);
    CHECK((closest_of({f[0], f[2], f[1], f[3]}, 1).difference - of_face).norm() < kSlack);
  }
}

TEST_CASE("closest points: corners, borders and insides of a face have their closed forms",
          "[contact]") {
  const std::array<Vec3, 3> face{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  struct Case {
    Vec3 place, difference;
    std::array<double, 4> weights;
  };
  const Case each = GENERATE(Case{{0.25, 0.25, 2}, {0, 0, -2}, {1, 0.5, 0.25, 0.25}},
                             Case{{-3, -4, 0}, {3, 4, 0}, {1, 1, 0, 0}},
                             Case{{4, -1, 1}, {-3, 1, -1}, {1, 0, 1, 0}},
                             Case{{0.25, -2, 1}, {0, 2, -1}, {1, 0.75, 0.25, 0}},
                             Case{{1, 1, 0}, {-0.5, -0.5, 0}, {1, 0, 0.5, 0.5}},
                             Case{{-1, 0.5, 0}, {1, 0, 0}, {1, 0.5, 0, 0.5}});
  CAPTURE(each.place);
  const ClosestPoints closest = closest_of({each.place, face[0], face[1], face[2]}, 1);
  CHECK((closest.difference - each.difference).norm() < 1e-15);
  for (std::size_t k = 0; k < 4; ++k)
    CHECK(closest.weights[k] == Approx(each.weights[k]).margin(1e-15));
}

TEST_CASE("surface pair: sides named in any order make one pair", "[contact]") {
  const VertexId a(4), b(2), c(9), d(7);
  CHECK(edge_pair({a, b}, {c, d}) == edge_pair({d, c}, {b, a}));
  CHECK(vertex_face_pair(a, {b, c, d}) == vertex_face_pair(a, {d, b, c}));
  CHECK_FALSE(vertex_face_pair(a, {b, c, d}) == vertex_face_pair(b, {a, c, d}));
  CHECK_FALSE(edge_pair({a, b}, {c, d}) == edge_pair({a, c}, {b, d}));
  CHECK(vertex_face_pair(a, {b, c, d}) < edge_pair({b, d}, {a, c}));
  CHECK(edge_pair({a, b}, {c, d}) < edge_pair({a, c}, {d, b}));
}

}  // namespace pleat
