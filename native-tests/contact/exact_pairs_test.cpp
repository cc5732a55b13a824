#include "native-tests/support/exact_pairs.h"

#include <catch2/catch.hpp>

namespace pleat {

TEST_CASE("exact pairs: an edge through a triangle crosses it, one beside does not", "[contact]") {
  const double off = GENERATE(0.0, 1e4);
  const Vec3 shift(off, -off, off);
  const std::array<Vec3, 3> face{shift, Vec3(1, 0, 0) + shift, Vec3(0, 1, 0) + shift};
  const auto meets = [&](const Vec3& a, const Vec3& b) {
    return edge_and_triangle({a + shift, b + shift}, face);
  };
  CHECK(meets({0.25, 0.25, -1}, {0.25, 0.25, 1}) == Meeting::crossing);
  CHECK(meets({0.25, 0.25, 1}, {0.25, 0.25, 0x1p-39}) == Meeting::apart);
  CHECK(meets({0.25, 0.25, 1}, {0.25, 0.25, 0}) == Meeting::touching);
  CHECK(meets({0.5, 0.5, -1}, {0.5, 0.5, 1}) == Meeting::touching);
  CHECK(meets({0.5, 0.5 + 0x1p-39, -1}, {0.5, 0.5 + 0x1p-39, 1}) == Meeting::apart);
  CHECK(meets({0.5, 0.5 - 0x1p-39, -1}, {0.5, 0.5 - 0x1p-39, 1}) == Meeting::crossing);
  CHECK(meets({-1, 0.25, 0}, {2, 0.25, 0}) == Meeting::touching);
}

TEST_CASE("exact pairs: sums and products of doubles keep every bit", "[contact]") {
  const double tiny = 0x1p-200;
  CHECK((Exact(1) + tiny - 1.0 - tiny).sign() == 0);
  CHECK((Exact(1) + tiny - 1.0).sign() == 1);
  CHECK(((Exact(1) + tiny) * (Exact(1) - tiny) - 1.0 + Exact(tiny) * tiny).sign() == 0);
  CHECK(((Exact(1) + tiny) * (Exact(1) - tiny) - 1.0).sign() == -1);
}

TEST_CASE("exact pairs: a motion meets in time, and not beside", "[contact]") {
  const double beside = GENERATE(-1e-6, -1e-9, 1e-9, 1e-6);
  PairMotion motion;
  motion.begin = {Vec3(0.5 + beside, 0.5, 1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  motion.end = {Vec3(0.5 + beside, 0.5, -2), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  CHECK(may_meet(motion) == (beside < 0));
  motion.n_first = 2;
  motion.begin = {Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(1 + beside, -1, 0), Vec3(1 + beside, 1, 0)};
  motion.end = {Vec3(0, 0, -3), Vec3(1, 0, -3), Vec3(1 + beside, -1, 0), Vec3(1 + beside, 1, 0)};
  CHECK(may_meet(motion) == (beside < 0));
}

}  // namespace pleat
