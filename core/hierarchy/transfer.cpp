#include "core/hierarchy/transfer.h"

#include <Eigen/Eigenvalues>

#include "core/base/check.h"

namespace pleat {
namespace {

using Terms = std::vector<Transfer::Term>;

/// Weighs parents by the square of the inverse distance from `place` [m].
void weigh_by_distance(Terms& parents, const Positions& coarse, const Vec3& place) {
  double sum = 0;
  for (Transfer::Term& parent : parents) {
    const double squared = (coarse.col(parent.coarse) - place).squaredNorm();
    if (squared == 0) {
      parents = {{parent.coarse, 1}};
      return;
    }
    parent.weight = 1 / squared;
    sum += parent.weight;
  }
  for (Transfer::Term& parent : parents) parent.weight /= sum;
}

/// Offsets d_i of the parents, weights w_i, their mean m = sum w d and scatter
/// G = sum w (d - m)(d - m)^T. The linear function that fits values at the parents best in the sum
/// of w has at the place itself the weights w_i (1 - (d_i - m).G^-1 m). Across directions in which
/// the parents hardly lie apart the function is constant.
void fit_linear(Terms& parents, const Positions& coarse, const Vec3& place) {
  constexpr double kFlat = 1e-2;  // share of the largest spread squared: a tenth of its length
  Vec3 mean = Vec3::Zero();
  for (const auto& [parent, weight] : parents) mean += weight * (coarse.col(parent) - place);
  Mat3 scatter = Mat3::Zero();
  for (const auto& [parent, weight] : parents) {
    const Vec3 offset = coarse.col(parent) - place - mean;
    scatter += weight * offset * offset.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> spread(scatter);
  Vec3 slope = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    if (spread.eigenvalues()(k) <= kFlat * spread.eigenvalues()(2)) continue;
    const Vec3 axis = spread.eigenvectors().col(k);
    slope += axis.dot(mean) / spread.eigenvalues()(k) * axis;
  }
  for (auto& [parent, weight] : parents) weight *= 1 - slope.dot(coarse.col(parent) - place - mean);
}

class Parents {
 public:
  Parents(const std::vector<VertexId>& kept, const std::vector<std::vector<VertexId>>& neighbours)
      : neighbours_(neighbours), coarse_of_(neighbours.size()), ring_of_(neighbours.size(), -1) {
    for (std::size_t i = 0; i < kept.size(); ++i)
      coarse_of_[kept[i]] = VertexId(static_cast<std::int64_t>(i));
  }

  /// Terms of a vertex by the parents' numbers among the kept vertices, ring by ring.
  Terms of(VertexId vertex) {
    if (coarse_of_[vertex].valid()) return {{coarse_of_[vertex], 1}};
    constexpr std::size_t kFewest = 2;
    Terms found;
    std::vector<VertexId> seen{vertex};
    ring_of_[vertex] = 0;
    std::size_t begin = 0;
    while (found.size() < kFewest && begin < seen.size()) {
      const std::size_t end = seen.size();
      for (std::size_t i = begin; i < end; ++i)
        for (const VertexId v : neighbours_[seen[i]]) {
          if (ring_of_[v] >= 0) continue;
          ring_of_[v] = 1;
          seen.push_back(v);
          if (coarse_of_[v].valid()) found.push_back({coarse_of_[v], 0});
        }
      begin = end;
    }
    for (const VertexId v : seen) ring_of_[v] = -1;
    PLEAT_CHECK(!found.empty(), "some vertex of each connected part is kept");
    return found;
  }

 private:
  const std::vector<std::vector<VertexId>>& neighbours_;
  std::vector<VertexId> coarse_of_;
  std::vector<std::int32_t> ring_of_;  ///< state of the current walk: seen, or -1
};

}  // namespace

Positions Transfer::operator*(const Positions& coarse) const {
  Positions fine = Positions::Zero(3, n_rows());
  for (int row = 0; row < n_rows(); ++row)
    for (std::int32_t i = begin[static_cast<std::size_t>(row)];
         i < begin[static_cast<std::size_t>(row) + 1]; ++i) {
      const auto& [vertex, weight] = terms[static_cast<std::size_t>(i)];
      fine.col(row) += weight * coarse.col(vertex);
    }
  return fine;
}

Transfer transfer_between(const std::vector<VertexId>& kept,
                          const std::vector<std::vector<VertexId>>& neighbours,
                          const Positions& positions, TransferWeights weights) {
  PLEAT_CHECK(positions.cols() == static_cast<Eigen::Index>(neighbours.size()),
              "neighbours of every vertex");
  Positions coarse(3, static_cast<Eigen::Index>(kept.size()));
  for (std::size_t i = 0; i < kept.size(); ++i)
    coarse.col(static_cast<Eigen::Index>(i)) = positions.col(kept[i]);
  Parents parents(kept, neighbours);
  Transfer transfer;
  for (Eigen::Index v = 0; v < positions.cols(); ++v) {
    Terms terms = parents.of(VertexId(v));
    if (terms.size() > 1) {
      weigh_by_distance(terms, coarse, positions.col(v));
      if (weights == TransferWeights::moving_least_squares && terms.size() > 1)
        fit_linear(terms, coarse, positions.col(v));
    } else {
      terms[0].weight = 1;
    }
    transfer.terms.insert(transfer.terms.end(), terms.begin(), terms.end());
    transfer.begin.push_back(static_cast<std::int32_t>(transfer.terms.size()));
  }
  return transfer;
}

double linear_error(const Transfer& transfer, const Positions& coarse, const Positions& fine) {
  if (fine.cols() == 0) return 0;
  return (transfer * coarse - fine).colwise().norm().maxCoeff();
}

}  // namespace pleat
