#include "core/linalg/aggregation/coarsening.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/base/simd.h"

namespace pleat {
namespace {

/// A motion that keeps less of its length beside those before it depends on them.
constexpr double kLeastLength = 1e-3;

/// w of the smoothed prolongation: 4/3 over the largest eigenvalue of D^-1 A, which is 2 for
/// springs and slightly more for cloth.
constexpr double kFading = 0.6;

template <int B>
bool is_zero(const double* block) {
  for (int k = 0; k < B * B; ++k)
    if (block[k] != 0) return false;
  return true;
}

/// product += A Q for B x B A, or its transpose, and B x 6 Q, all by rows.
template <int B>
inline void add_product(const double* A, bool transposed, const double* Q, double* product) {
  const int next_row = transposed ? 1 : B;
  const int next_column = transposed ? B : 1;
  for (int r = 0; r < B; ++r) {
    double sums[kRigid];
    for (int c = 0; c < kRigid; ++c) sums[c] = product[r * kRigid + c];
    for (int k = 0; k < B; ++k) {
      const double factor = A[r * next_row + k * next_column];
      for (int c = 0; c < kRigid; ++c) sums[c] += factor * Q[k * kRigid + c];
    }
    for (int c = 0; c < kRigid; ++c) product[r * kRigid + c] = sums[c];
  }
}

/// product += P'Q for B x 6 P and Q, all by rows.
template <int B>
inline void add_transposed_product(const double* P, const double* Q, double* product) {
  for (int a = 0; a < kRigid; ++a) {
    double sums[kRigid];
    for (int c = 0; c < kRigid; ++c) sums[c] = product[a * kRigid + c];
    for (int r = 0; r < B; ++r)
      for (int c = 0; c < kRigid; ++c) sums[c] += P[r * kRigid + a] * Q[r * kRigid + c];
    for (int c = 0; c < kRigid; ++c) product[a * kRigid + c] = sums[c];
  }
}

}  // namespace

/// Calls work(column, block of A or its transpose, is it transposed) for a row, ascending.
template <int B>
template <class Work>
void Coarsening<B>::for_each_block(const BlockLevel<B>& fine, int row, const Work& work) const {
  const LowerPattern& pattern = fine.pattern();
  for (int k = pattern.begins[place(row)]; k < pattern.begins[place(row) + 1]; ++k)
    work(pattern.columns[place(k)], fine.lower(k), false);
  work(row, fine.diagonal(row), false);
  for (int k = pattern.column_begins[place(row)]; k < pattern.column_begins[place(row) + 1]; ++k)
    work(pattern.column_rows[place(k)], fine.lower(pattern.column_blocks[place(k)]), true);
}

template <int B>
void Coarsening<B>::analyze(const BlockLevel<B>& fine, const Aggregates& groups,
                            BlockLevel<kRigid>& coarse) {
  const int n = fine.n_rows();
  n_groups_ = groups.count;
  groups_ = groups.of_node;
  member_begins_.assign(place(n_groups_) + 1, 0);
  for (const int group : groups_)
    if (group >= 0) ++member_begins_[place(group) + 1];
  for (int group = 0; group < n_groups_; ++group)
    member_begins_[place(group) + 1] += member_begins_[place(group)];
  members_.resize(place(member_begins_.back()));
  std::vector<int> next(member_begins_.begin(), member_begins_.end() - 1);
  for (int row = 0; row < n; ++row)
    if (groups_[place(row)] >= 0) members_[place(next[place(groups_[place(row)])]++)] = row;

  slots_.assign(place(n_groups_), -1);
  // Lists the distinct groups that `collect` puts in, ascending.
  const auto add_row = [&](std::vector<int>& begins, std::vector<int>& columns,
                           const auto& collect) {
    const auto first = static_cast<std::ptrdiff_t>(columns.size());
    collect([&](int group) {
      if (group < 0 || slots_[place(group)] >= 0) return;
      slots_[place(group)] = 0;
      columns.push_back(group);
    });
    std::sort(columns.begin() + first, columns.end());
    for (auto at = columns.begin() + first; at != columns.end(); ++at) slots_[place(*at)] = -1;
    begins.push_back(static_cast<int>(columns.size()));
  };
  begins_.assign(1, 0);
  columns_.clear();
  for (int row = 0; row < n; ++row)
    add_row(begins_, columns_, [&](const auto& put) {
      for_each_block(fine, row, [&](int k, const double*, bool) { put(groups_[place(k)]); });
    });
  product_begins_.assign(1, 0);
  product_columns_.clear();
  for (int row = 0; row < n; ++row)
    add_row(product_begins_, product_columns_, [&](const auto& put) {
      for_each_block(fine, row, [&](int k, const double*, bool) {
        for (int p = begin(k); p < begin(k + 1); ++p) put(column(p));
      });
    });

  std::vector<std::vector<int>> neighbours(place(n_groups_));
  const auto for_each_target = [&](const auto& work) {
    for (int row = 0; row < n; ++row)
      for (int p = begin(row); p < begin(row + 1); ++p)
        for (int q = product_begins_[place(row)]; q < product_begins_[place(row) + 1]; ++q)
          if (product_columns_[place(q)] <= column(p)) work(column(p), product_columns_[place(q)]);
  };
  for_each_target([&](int group, int other) {
    std::vector<int>& own = neighbours[place(group)];
    if (other < group && std::find(own.begin(), own.end(), other) == own.end())
      own.push_back(other);
  });
  LowerPattern pattern;
  for (std::vector<int>& own : neighbours) {
    std::sort(own.begin(), own.end());
    pattern.columns.insert(pattern.columns.end(), own.begin(), own.end());
    pattern.begins.push_back(static_cast<int>(pattern.columns.size()));
  }
  pattern.find_columns();
  targets_.clear();
  for_each_target([&](int group, int other) {
    if (other == group) {
      targets_.push_back(group);
      return;
    }
    const auto first = pattern.columns.begin() + pattern.begins[place(group)];
    const auto last = pattern.columns.begin() + pattern.begins[place(group) + 1];
    targets_.push_back(n_groups_ + static_cast<int>(std::lower_bound(first, last, other) -
                                                    pattern.columns.begin()));
  });
  coarse.set_pattern(std::move(pattern));

  tentative_.assign(place(n) * kSize, 0.0);
  values_.assign(columns_.size() * kSize + kLoadRoom, 0.0F);
  exact_.assign(columns_.size() * kSize, 0.0);
  std::size_t widest = 0;
  for (int row = 0; row < n; ++row)
    widest = std::max(widest, place(product_begins_[place(row) + 1] - product_begins_[place(row)]));
  products_.assign(widest * kSize, 0.0);
}

/// Turns the motions of a group's members, in tentative_, into orthonormal ones by Gram and
/// Schmidt, twice for all digits. The group's motions are those of the members in the new unknowns.
template <int B>
void Coarsening<B>::orthonormalise(int group, RigidMotions<kRigid>& coarse_motions) {
  double* R = coarse_motions.motions.data() + group * kRigid * kRigid;
  std::fill_n(R, kRigid * kRigid, 0.0);
  const int first = member_begins_[place(group)];
  const int last = member_begins_[place(group) + 1];
  // Inner product of the columns a and b.
  const auto product = [&](int a, int b) {
    double sum = 0;
    for (int m = first; m < last; ++m) {
      const double* T = tentative(members_[place(m)]);
      for (int r = 0; r < B; ++r) sum += T[r * kRigid + a] * T[r * kRigid + b];
    }
    return sum;
  };
  const auto subtract = [&](int a, double factor, int from) {
    for (int m = first; m < last; ++m) {
      double* T = tentative_.data() + members_[place(m)] * kSize;
      for (int r = 0; r < B; ++r) T[r * kRigid + from] -= factor * T[r * kRigid + a];
    }
  };
  double largest[2] = {0, 0};  // squared lengths, of translations and rotations
  for (int c = 0; c < kRigid; ++c) largest[c / 3] = std::max(largest[c / 3], product(c, c));
  for (int c = 0; c < kRigid; ++c) {
    for (int time = 0; time < 2; ++time) {
      for (int a = 0; a < c; ++a) {
        const double share = product(a, c);
        R[a * kRigid + c] += share;
        subtract(a, share, c);
      }
    }
    const double length = std::sqrt(product(c, c));
    const bool depends = !(length > kLeastLength * std::sqrt(largest[c / 3]));
    R[c * kRigid + c] = depends ? 0 : length;
    subtract(c, depends ? 1 : 1 - 1 / length, c);
  }
}

template <int B>
void Coarsening<B>::find_tentative(const BlockLevel<B>& fine, const RigidMotions<B>& fine_motions,
                                   RigidMotions<kRigid>& coarse_motions) {
  const bool turns = !fine_motions.places.empty();
  coarse_motions.places.resize(turns ? place(n_groups_) * 3 : 0);
  coarse_motions.motions.resize(place(n_groups_) * kRigid * kRigid);
  std::fill(tentative_.begin(), tentative_.end(), 0.0);
  for (int group = 0; group < n_groups_; ++group) {
    const int first = member_begins_[place(group)];
    const int last = member_begins_[place(group) + 1];
    double middle[3] = {0, 0, 0};
    for (int m = first; turns && m < last; ++m)
      for (int k = 0; k < 3; ++k)
        middle[k] += fine_motions.places[place(3 * members_[place(m)] + k)] / (last - first);
    for (int k = 0; turns && k < 3; ++k) coarse_motions.places[place(3 * group + k)] = middle[k];
    for (int m = first; m < last; ++m) {
      const int row = members_[place(m)];
      bool is_alone = true;
      for_each_block(fine, row, [&](int column, const double* block, bool) {
        if (column != row && is_alone) is_alone = is_zero<B>(block);
      });
      if (is_alone) continue;
      double* T = tentative_.data() + row * kSize;
      std::copy_n(fine_motions.motions.data() + row * kSize, kSize, T);
      if (!turns) continue;
      double d[3];
      for (int k = 0; k < 3; ++k) d[k] = fine_motions.places[place(3 * row + k)] - middle[k];
      for (int r = 0; r < B; ++r) {
        double* t = T + r * kRigid;  // its rotations, and translations by e_k x d
        t[3] += t[2] * d[1] - t[1] * d[2];
        t[4] += t[0] * d[2] - t[2] * d[0];
        t[5] += t[1] * d[0] - t[0] * d[1];
      }
    }
    orthonormalise(group, coarse_motions);
  }
}

template <int B>
void Coarsening<B>::smooth_tentative(const BlockLevel<B>& fine) {
  for (int row = 0; row < fine.n_rows(); ++row) {
    const double* C = fine.root(row);
    double* T = tentative_.data() + row * kSize;
    for (int r = 0; r < B; ++r) {
      for (int c = 0; c < kRigid; ++c) {
        double sum = 0;
        for (int k = r; k < B; ++k) sum += C[k * B + r] * T[k * kRigid + c];
        T[r * kRigid + c] = sum;
      }
    }
  }
  for (int row = 0; row < fine.n_rows(); ++row) {
    const int first = begin(row);
    const int count = begin(row + 1) - first;
    for (int p = 0; p < count; ++p) slots_[place(column(first + p))] = p;
    std::fill_n(products_.begin(), count * kSize, 0.0);
    for_each_block(fine, row, [&](int k, const double* block, bool transposed) {
      const int group = groups_[place(k)];
      if (group < 0) return;
      add_product<B>(block, transposed, tentative(k),
                     products_.data() + slots_[place(group)] * kSize);
    });
    for (int p = 0; p < count; ++p) {
      double* P = exact_.data() + (first + p) * kSize;
      const double* product = products_.data() + p * kSize;
      const bool is_own = column(first + p) == groups_[place(row)];
      for (int k = 0; k < kSize; ++k)
        P[k] = (is_own ? tentative(row)[k] : 0) - kFading * product[k];
    }
  }
}

template <int B>
void Coarsening<B>::multiply_out(const BlockLevel<B>& fine, BlockLevel<kRigid>& coarse) {
  std::fill(coarse.values().begin(), coarse.values().end(), 0.0);
  const int* target = targets_.data();
  for (int row = 0; row < fine.n_rows(); ++row) {
    const int first = product_begins_[place(row)];
    const int count = product_begins_[place(row) + 1] - first;
    for (int q = 0; q < count; ++q) slots_[place(product_columns_[place(first + q)])] = q;
    std::fill_n(products_.begin(), count * kSize, 0.0);
    for_each_block(fine, row, [&](int k, const double* A, bool transposed) {
      for (int p = begin(k); p < begin(k + 1); ++p)
        add_product<B>(A, transposed, exact_.data() + p * kSize,
                       products_.data() + slots_[place(column(p))] * kSize);
    });
    for (int p = begin(row); p < begin(row + 1); ++p) {
      const double* P = exact_.data() + p * kSize;
      for (int q = 0; q < count && product_columns_[place(first + q)] <= column(p); ++q) {
        double* sum = coarse.values().data() + *target++ * kRigid * kRigid;
        add_transposed_product<B>(P, products_.data() + q * kSize, sum);
      }
    }
  }
  for (int group = 0; group < n_groups_; ++group)
    for (int k = 0; k < kRigid; ++k) {
      double& entry = coarse.diagonal(group)[k * (kRigid + 1)];
      if (!(entry > 0)) entry = 1;
    }
}

/// P V' for the inverse root V of each group.
template <int B>
void Coarsening<B>::scale_coarse(const BlockLevel<kRigid>& coarse) {
  const auto n_blocks = static_cast<int>(columns_.size());
  for (int p = 0; p < n_blocks; ++p) {
    const double* V = coarse.inverse_root(column(p));
    for (int r = 0; r < B; ++r) {
      for (int c = 0; c < kRigid; ++c) {
        double sum = 0;
        for (int k = 0; k <= c; ++k) sum += block(p)[r * kRigid + k] * V[c * kRigid + k];
        values_[place((p * B + r) * kRigid + c)] = static_cast<float>(sum);
      }
    }
  }
}

template <int B>
void Coarsening<B>::compute(const BlockLevel<B>& fine, const RigidMotions<B>& fine_motions,
                            BlockLevel<kRigid>& coarse, RigidMotions<kRigid>& coarse_motions) {
  find_tentative(fine, fine_motions, coarse_motions);
  smooth_tentative(fine);
  multiply_out(fine, coarse);
  coarse.scale();
  scale_coarse(coarse);
}

template <int B>
void Coarsening<B>::restrict_to(const float* r, float* b) const {
  std::fill_n(b, n_groups_ * kLanes<kRigid>, 0.0F);
  const int n = static_cast<int>(begins_.size()) - 1;
  for (int row = 0; row < n; ++row) {
    for (int p = begin(row); p < begin(row + 1); ++p) {
      float* sum = b + column(p) * kLanes<kRigid>;
      Float4 low = Float4::load(sum);
      Float4 high = Float4::load(sum + 4);
      for (int k = 0; k < B; ++k) {
        const Float4 factor = Float4::all(r[row * kLanes<B> + k]);
        low = low + factor * Float4::load(scaled_block(p) + k * kRigid);
        high = high + factor * Float4::load(scaled_block(p) + k * kRigid + 4);
      }
      low.store(sum);
      high.store(sum + 4);
    }
  }
}

template <int B>
// NOLINTNEXTLINE(readability-non-const-parameter): it is written, in a form that is not seen.
void Coarsening<B>::add_prolonged(const float* e, float* x) const {
  const int n = static_cast<int>(begins_.size()) - 1;
  for (int row = 0; row < n; ++row) {
    Float4 sums[B] = {};
    for (int p = begin(row); p < begin(row + 1); ++p) {
      const Float4 low = Float4::load(e + column(p) * kLanes<kRigid>);
      const Float4 high = Float4::load(e + column(p) * kLanes<kRigid> + 4);
      for (int k = 0; k < B; ++k)
        sums[k] = sums[k] + (Float4::load(scaled_block(p) + k * kRigid) * low +
                             Float4::load(scaled_block(p) + k * kRigid + 4) * high);
    }
    for (int k = 0; k < B; ++k) x[row * kLanes<B> + k] += sum_of_lanes<float>(sums[k]);
  }
}

template class Coarsening<3>;
template class Coarsening<kRigid>;

}  // namespace pleat
