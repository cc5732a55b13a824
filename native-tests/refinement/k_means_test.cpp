#include "core/refinement/k_means.h"

#include <catch2/catch.hpp>
#include <limits>
#include <tuple>

#include "core/base/check.h"

namespace pleat {
namespace {

PlanePoints random_points(int n, Random& random) {
  PlanePoints points(2, n);
  for (int i = 0; i < n; ++i) points.col(i) << random.uniform(0, 1), random.uniform(0, 1);
  return points;
}

/// The least sum of squares of all k^n assignments.
double least_within(const PlanePoints& points, int k) {
  const auto n = static_cast<int>(points.cols());
  int n_assignments = 1;
  for (int i = 0; i < n; ++i) n_assignments *= k;
  double least = std::numeric_limits<double>::infinity();
  for (int code = 0; code < n_assignments; ++code) {
    PlanePoints sums = PlanePoints::Zero(2, k);
    Eigen::VectorXd counts = Eigen::VectorXd::Zero(k);
    for (int i = 0, rest = code; i < n; ++i, rest /= k) {
      sums.col(rest % k) += points.col(i);
      ++counts[rest % k];
    }
    double within = 0;
    for (int i = 0, rest = code; i < n; ++i, rest /= k)
      within += (points.col(i) - sums.col(rest % k) / counts[rest % k]).squaredNorm();
    least = std::min(least, within);
  }
  return least;
}

}  // namespace

TEST_CASE("k-means: no assignment of a small set is better", "[refinement]") {
  const int k = GENERATE(1, 2, 3);
  const int n = GENERATE(3, 5, 8);
  const auto seed = static_cast<std::uint64_t>(GENERATE(1, 2, 3, 4, 5));
  CAPTURE(k, n, seed);
  Random random(seed);
  const PlanePoints points = random_points(n, random);
  const Clusters clusters = k_means(points, k, 16, random);
  CHECK(clusters.within == Approx(least_within(points, k)).epsilon(1e-12).margin(1e-15));
}

TEST_CASE("k-means: points go to the nearest centre, centres to their mean", "[refinement]") {
  // From each of the last three seeds, a cluster loses all its points on the way.
  const auto sizes = GENERATE(std::tuple(400, 5, 7), std::tuple(7, 3, 193), std::tuple(13, 3, 500),
                              std::tuple(14, 5, 121));
  const auto [n, k, seed] = sizes;
  CAPTURE(n, k, seed);
  Random random(static_cast<std::uint64_t>(seed));
  const PlanePoints points = random_points(n, random);
  const Clusters clusters = k_means(points, k, 1, random);
  PlanePoints sums = PlanePoints::Zero(2, k);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(k);
  double within = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const int mine = clusters.of_points[static_cast<std::size_t>(i)];
    const Eigen::VectorXd squares =
        (clusters.centres.colwise() - points.col(i)).colwise().squaredNorm();
    CHECK(squares[mine] == squares.minCoeff());
    within += squares[mine];
    sums.col(mine) += points.col(i);
    ++counts[mine];
  }
  CHECK(clusters.within == Approx(within).epsilon(1e-12));
  for (int c = 0; c < k; ++c) {
    REQUIRE(counts[c] > 0);
    CHECK((sums.col(c) / counts[c] - clusters.centres.col(c)).norm() < 1e-12);
  }
}

TEST_CASE("k-means: as many clusters as different points leave nothing within", "[refinement]") {
  PlanePoints points(2, 9);
  for (int i = 0; i < 9; ++i) points.col(i) << i % 3, 2 * (i % 3);
  Random random(3);
  const Clusters clusters = k_means(points, 3, 4, random);
  CHECK(clusters.within == 0);
  for (int i = 3; i < 9; ++i)
    CHECK(clusters.of_points[static_cast<std::size_t>(i)] ==
          clusters.of_points[static_cast<std::size_t>(i - 3)]);
}

TEST_CASE("k-means: more clusters than different points are refused with both numbers",
          "[refinement]") {
  PlanePoints points = PlanePoints::Ones(2, 6);
  points(0, 2) = 2;
  Random random(1);
  CHECK_NOTHROW(k_means(points, 2, 3, random));
  CHECK_THROWS_WITH(k_means(points, 3, 3, random),
                    Catch::Contains("which is 2") && Catch::Contains("got 3"));
}

TEST_CASE("k-means: the same seed gives the same clusters", "[refinement]") {
  Random points_random(5);
  const PlanePoints points = random_points(300, points_random);
  Random a(11);
  Random b(11);
  const Clusters first = k_means(points, 4, 3, a);
  const Clusters second = k_means(points, 4, 3, b);
  CHECK(first.of_points == second.of_points);
  CHECK(first.centres == second.centres);
}

}  // namespace pleat
