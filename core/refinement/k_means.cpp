#include "core/refinement/k_means.h"

#include <set>
#include <string>
#include <utility>

#include "core/base/check.h"

namespace pleat {
namespace {

void check_distinct(const PlanePoints& points, int k) {
  std::set<std::pair<double, double>> distinct;
  for (const auto& point : points.colwise()) {
    distinct.emplace(point.x(), point.y());
    if (distinct.size() >= static_cast<std::size_t>(k)) return;
  }
  throw InputError("number of patterns",
                   "expected at most the number of different features, which is " +
                       std::to_string(distinct.size()) + ", got " + std::to_string(k));
}

/// The first index at which the running sum of weights exceeds `part`, 0 <= part < sum. One that
/// weighs nothing is never it.
Eigen::Index drawn(const Eigen::VectorXd& weights, double part) {
  Eigen::Index last = 0;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    if (weights[i] <= 0) continue;
    last = i;
    part -= weights[i];
    if (part < 0) break;
  }
  return last;
}

PlanePoints seeds(const PlanePoints& points, int k, Random& random) {
  PlanePoints centres(2, k);
  centres.col(0) = points.col(random.below(points.cols()));
  Eigen::VectorXd squares = (points.colwise() - centres.col(0)).colwise().squaredNorm();
  for (int c = 1; c < k; ++c) {
    centres.col(c) = points.col(drawn(squares, random.uniform(0, squares.sum())));
    squares =
        squares.cwiseMin((points.colwise() - centres.col(c)).colwise().squaredNorm().transpose());
  }
  return centres;
}

/// Sends each point to the nearest centre, ties to the one it has. True when one has moved.
bool assign(const PlanePoints& points, Clusters& clusters) {
  bool has_moved = false;
  clusters.within = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    int& mine = clusters.of_points[static_cast<std::size_t>(i)];
    const auto square = [&](int c) {
      return (points.col(i) - clusters.centres.col(c)).squaredNorm();
    };
    const int before = mine;
    double nearest = square(mine);
    for (int c = 0; c < clusters.centres.cols(); ++c) {
      const double other = square(c);
      if (other >= nearest) continue;
      nearest = other;
      mine = c;
    }
    has_moved = has_moved || mine != before;
    clusters.within += nearest;
  }
  return has_moved;
}

/// Centres become the means of their points. True when an empty cluster has taken a point.
bool update(const PlanePoints& points, Clusters& clusters) {
  const Eigen::Index k = clusters.centres.cols();
  Eigen::VectorXi counts = Eigen::VectorXi::Zero(k);
  for (const int c : clusters.of_points) ++counts[c];
  bool has_taken = false;
  for (int c = 0; c < k; ++c) {
    if (counts[c] > 0) continue;
    Eigen::Index farthest = 0;
    double largest = -1;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const int other = clusters.of_points[static_cast<std::size_t>(i)];
      const double square = (points.col(i) - clusters.centres.col(other)).squaredNorm();
      if (counts[other] < 2 || square <= largest) continue;
      largest = square;
      farthest = i;
    }
    int& mine = clusters.of_points[static_cast<std::size_t>(farthest)];
    --counts[mine];
    ++counts[c];
    mine = c;
    clusters.centres.col(c) = points.col(farthest);
    has_taken = true;
  }
  clusters.centres.setZero();
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    clusters.centres.col(clusters.of_points[static_cast<std::size_t>(i)]) += points.col(i);
  clusters.centres.array().rowwise() /= counts.cast<double>().transpose().array();
  return has_taken;
}

Clusters lloyd(const PlanePoints& points, PlanePoints centres) {
  constexpr int kMaxRounds = 1000;  // the sum falls each round; rounding could make it circle
  Clusters clusters{std::move(centres),
                    std::vector<int>(static_cast<std::size_t>(points.cols()), 0), 0};
  assign(points, clusters);
  for (int round = 0; round < kMaxRounds; ++round) {
    const bool has_taken = update(points, clusters);
    if (!assign(points, clusters) && !has_taken) break;
  }
  return clusters;
}

}  // namespace

Clusters k_means(const PlanePoints& points, int k, int n_runs, Random& random) {
  PLEAT_CHECK(k >= 1 && n_runs >= 1, "at least one cluster and one run");
  check_distinct(points, k);
  Clusters best = lloyd(points, seeds(points, k, random));
  for (int run = 1; run < n_runs; ++run) {
    Clusters other = lloyd(points, seeds(points, k, random));
    if (other.within < best.within) best = std::move(other);
  }
  return best;
}

}  // namespace pleat
