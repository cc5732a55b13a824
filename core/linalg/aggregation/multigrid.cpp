#include "core/linalg/aggregation/multigrid.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/linalg/aggregation/aggregation.h"

namespace pleat {
namespace {

/// Rows of a group: fewer make coarse levels dearer, more leave the smoother with more to do.
constexpr int kGroup = 10;

/// Rows of the coarsest level, which is solved densely.
constexpr int kDenseRows = 24;

/// Times that a coarse level goes to the next coarser one. With one the iterations grow with the
/// number of levels; two cost little, as levels are ten times as small each.
constexpr int kCoarseVisits = 2;

/// A coarser level with more than this share of a level's rows is not worth having.
constexpr double kLargestShare = 0.7;

LowerPattern pattern_of(const BlockMatrix& A) {
  LowerPattern pattern;
  for (int row = 0; row < A.n_rows(); ++row) {
    for (int k = A.begin(row); k < A.begin(row + 1); ++k) pattern.columns.push_back(A.column(k));
    pattern.begins.push_back(A.begin(row + 1));
  }
  pattern.find_columns();
  return pattern;
}

}  // namespace

void Multigrid::analyze(const BlockMatrix& A) {
  finest_.set_pattern(pattern_of(A));
  finest_motions_.places.clear();
  finest_motions_.motions.assign(place(A.n_rows()) * 3 * kRigid, 0.0);
  for (int row = 0; row < A.n_rows(); ++row)
    for (int k = 0; k < 3; ++k) finest_motions_.motions[place((row * 3 + k) * kRigid + k)] = 1;

  coarse_.clear();
  const auto add_level = [this](const auto& fine, auto& coarsening) {
    const Aggregates groups = aggregate(fine.pattern(), kGroup);
    if (groups.count == 0 || groups.count > kLargestShare * fine.n_rows()) return false;
    auto added = std::make_unique<CoarseLevel>();
    coarsening.analyze(fine, groups, added->level);
    coarse_.push_back(std::move(added));
    return true;
  };
  bool goes_on = add_level(finest_, to_first_);
  while (goes_on && coarse_.back()->level.n_rows() > kDenseRows) {
    CoarseLevel& last = *coarse_.back();
    goes_on = add_level(last.level, last.to_next);
  }
  const bool is_dense = !coarse_.empty() && coarse_.back()->level.n_rows() <= kDenseRows;
  coarsest_.resize(is_dense ? coarse_.back()->level.n_rows() * kRigid : 0);
}

void Multigrid::set_places(const BlockMatrix& A, const double* places) {
  finest_motions_.places.resize(place(A.n_rows()) * 3);
  A.gather(places, finest_motions_.places.data());
}

void Multigrid::take_values(const BlockMatrix& A) {
  for (int row = 0; row < A.n_rows(); ++row) {
    const double* S = A.diagonal_block(row);
    double* block = finest_.diagonal(row);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c <= r; ++c) block[3 * r + c] = block[3 * c + r] = S[r * (r + 1) / 2 + c];
  }
  const int n_blocks = A.begin(A.n_rows());
  if (n_blocks > 0) std::copy_n(A.block(0), n_blocks * kBlockSize, finest_.lower(0));
  finest_.scale();
}

void Multigrid::compute_coarsest() {
  const BlockLevel<kRigid>& last = coarse_.back()->level;
  const auto put = [this](int row, int column, const double* block) {
    for (int r = 0; r < kRigid; ++r)
      for (int c = 0; c < kRigid; ++c)
        coarsest_.entry(row * kRigid + r, column * kRigid + c) = block[r * kRigid + c];
  };
  coarsest_.set_zero();
  for (int row = 0; row < last.n_rows(); ++row) {
    put(row, row, last.diagonal(row));
    for (int k = last.pattern().begins[place(row)]; k < last.pattern().begins[place(row) + 1]; ++k)
      put(row, last.pattern().columns[place(k)], last.lower(k));
  }
  coarsest_.compute();
}

void Multigrid::compute(const BlockMatrix& A) {
  take_values(A);
  for (std::size_t k = 0; k < coarse_.size(); ++k) {
    CoarseLevel& to = *coarse_[k];
    if (k == 0)
      to_first_.compute(finest_, finest_motions_, to.level, to.motions);
    else
      coarse_[k - 1]->to_next.compute(coarse_[k - 1]->level, coarse_[k - 1]->motions, to.level,
                                      to.motions);
  }
  if (coarsest_.size() > 0) compute_coarsest();
}

void Multigrid::solve_coarsest() {
  BlockLevel<kRigid>& last = coarse_.back()->level;
  if (coarsest_.size() == 0) {
    last.smooth_from_zero();
    return;
  }
  double x[kDenseRows * kRigid];
  const auto lane = [](int k) { return k / kRigid * kLanes<kRigid> + k % kRigid; };
  for (int k = 0; k < coarsest_.size(); ++k) x[k] = static_cast<double>(last.rhs()[lane(k)]);
  coarsest_.solve(x);
  for (int k = 0; k < coarsest_.size(); ++k) last.solution()[lane(k)] = static_cast<float>(x[k]);
}

template <int B>
void Multigrid::cycle(BlockLevel<B>& level, const Coarsening<B>& to_coarser, std::size_t coarser,
                      int n_visits) {
  level.smooth_from_zero();
  for (int visit = 0; visit < n_visits && coarser < coarse_.size(); ++visit) {
    CoarseLevel& below = *coarse_[coarser];
    level.find_residual();
    to_coarser.restrict_to(level.residual(), below.level.rhs());
    if (coarser + 1 == coarse_.size())
      solve_coarsest();
    else
      cycle(below.level, below.to_next, coarser + 1, kCoarseVisits);
    to_coarser.add_prolonged(below.level.solution(), level.solution());
    level.smooth();
  }
}

void Multigrid::apply(const double* r, double size, double* z) {
  for (int row = 0; row < finest_.n_rows(); ++row) {
    const double* V = finest_.inverse_root(row);
    float* b = finest_.rhs() + row * kLanes<3>;
    const double* from = r + 3 * row;
    b[0] = static_cast<float>(V[0] * from[0] / size);
    b[1] = static_cast<float>((V[3] * from[0] + V[4] * from[1]) / size);
    b[2] = static_cast<float>((V[6] * from[0] + V[7] * from[1] + V[8] * from[2]) / size);
  }
  cycle(finest_, to_first_, 0, 1);
  for (int row = 0; row < finest_.n_rows(); ++row) {
    const double* V = finest_.inverse_root(row);
    const float* from = finest_.solution() + row * kLanes<3>;
    const double x[3] = {size * static_cast<double>(from[0]), size * static_cast<double>(from[1]),
                         size * static_cast<double>(from[2])};
    z[3 * row] = V[0] * x[0] + V[3] * x[1] + V[6] * x[2];
    z[3 * row + 1] = V[4] * x[1] + V[7] * x[2];
    z[3 * row + 2] = V[8] * x[2];
  }
}

}  // namespace pleat
