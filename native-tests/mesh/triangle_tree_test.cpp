#include "core/mesh/triangle_tree.h"

#include <catch2/catch.hpp>
#include <limits>

#include "core/base/random.h"

namespace pleat {
namespace {

Vec3 random_place(Random& random, double reach) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach),
          random.uniform(-reach, reach)};
}

Vec3 place_of(const Vec3& weights, const Corners& corners) {
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

/// Projects onto the plane, the three edges and the corners, and takes the best that lies within.
double distance_by_cases(const Vec3& p, const Corners& corners) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& a = corners[k];
    const Vec3 edge = corners[(k + 1) % 3] - a;
    const double share = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (p - a - share * edge).norm());
  }
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  const Vec3 foot = p - normal.dot(p - corners[0]) * normal;
  bool is_within = true;
  for (std::size_t k = 0; k < 3; ++k)
    is_within =
        is_within && normal.dot((corners[(k + 1) % 3] - corners[k]).cross(foot - corners[k])) >= 0;
  return is_within ? std::min(best, (p - foot).norm()) : best;
}

}  // namespace

TEST_CASE("triangle tree: the nearest point of a triangle is inside, on an edge or a corner",
          "[mesh]") {
  const Corners corners{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  CHECK(nearest_weights({1, 1, 7}, corners).isApprox(Vec3(0.5, 0.25, 0.25)));
  CHECK(nearest_weights({1, -3, 2}, corners).isApprox(Vec3(0.75, 0.25, 0)));
  CHECK(nearest_weights({9, -1, 0}, corners).isApprox(Vec3(0, 1, 0)));
  CHECK(nearest_weights({4, 4, 1}, corners).isApprox(Vec3(0, 0.5, 0.5)));
}

TEST_CASE("triangle tree: it finds the distance that every triangle was asked for", "[mesh]") {
  const int n_triangles = GENERATE(1, 4, 5, 200);
  CAPTURE(n_triangles);
  Random random(7);
  std::vector<Corners> triangles;
  for (int t = 0; t < n_triangles; ++t) {
    const Vec3 middle = random_place(random, 1);
    triangles.push_back({middle + random_place(random, 0.2), middle + random_place(random, 0.2),
                         middle + random_place(random, 0.2)});
  }
  TriangleTree tree(triangles);
  for (int k = 0; k < 200; ++k) {
    const Vec3 p = random_place(random, 2);
    double least = std::numeric_limits<double>::infinity();
    for (const Corners& corners : triangles) least = std::min(least, distance_by_cases(p, corners));
    const TriangleTree::Nearest found = tree.nearest(p);
    CHECK(std::sqrt(found.distance_squared) == Approx(least));
    const Corners& nearest = triangles[found.triangle];
    CHECK((place_of(nearest_weights(p, nearest), nearest) - p).norm() == Approx(least));
  }
}

}  // namespace pleat
