#include "core/linalg/direct/column_solve.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "core/base/simd.h"

namespace pleat {
namespace {

constexpr int kWidest = 4;  // columns of L that go together

using One = Simd<double, 1>;

/// Numbers of four columns, in two registers: compilers put four doubles in memory where there is
/// no register as wide.
struct Four {
  using Two = Simd<double, 2>;
  static constexpr int kLanes = 4;
  Two a, b;

  static Four load(const double* from) { return {Two::load(from), Two::load(from + 2)}; }
  static Four all(double number) { return {Two::all(number), Two::all(number)}; }
  void store(double* to) const {
    a.store(to);
    b.store(to + 2);
  }
};
Four operator-(const Four& x, const Four& y) { return {x.a - y.a, x.b - y.b}; }
Four operator*(const Four& x, const Four& y) { return {x.a * y.a, x.b * y.b}; }
Four operator/(const Four& x, const Four& y) { return {x.a / y.a, x.b / y.b}; }

/// Columns j to j + width - 1 of L, which have the same rows below them.
template <int width>
struct Block {
  Block(const LowerColumns& L, int j) : column(j), n_below(L.lengths[j] - width) {
    for (int c = 0; c < width; ++c) entries[c] = L.values + L.starts[j + c];
    rows = L.rows + L.starts[j] + width;
  }
  /// Entry of row j + r in column j + c.
  double triangle(int r, int c) const { return entries[c][r - c]; }
  /// Entry of row rows[r] in column j + c.
  double below(int r, int c) const { return entries[c][width - c + r]; }

  int column, n_below;
  std::array<const double*, width> entries;
  const int* rows;
};

/// Calls work(c) for 0 to n - 1, each a constant, so that arrays of lanes become registers.
template <int n, class Work>
void unrolled(const Work& work) {
  [&]<std::size_t... c>(std::index_sequence<c...>) {
    (work(std::integral_constant<int, static_cast<int>(c)>()), ...);
  }
  (std::make_index_sequence<n>());
}

/// Takes columns of L out of the rows below them. y: a group of lanes for each row of L.
template <class Lanes, int width>
void eliminate(const Block<width>& block, double* y) {
  const auto at = [y](int row) { return y + static_cast<std::ptrdiff_t>(row) * Lanes::kLanes; };
  std::array<Lanes, width> x;
  unrolled<width>([&](auto c) {
    x[c] = Lanes::load(at(block.column + c));
    unrolled<c>([&](auto k) { x[c] = x[c] - Lanes::all(block.triangle(c, k)) * x[k]; });
    x[c] = x[c] / Lanes::all(block.triangle(c, c));
    x[c].store(at(block.column + c));
  });
  for (int r = 0; r < block.n_below; ++r) {
    Lanes row = Lanes::load(at(block.rows[r]));
    unrolled<width>([&](auto c) { row = row - Lanes::all(block.below(r, c)) * x[c]; });
    row.store(at(block.rows[r]));
  }
}

/// Takes the rows below out of columns of L.
template <class Lanes, int width>
void substitute(const Block<width>& block, double* y) {
  const auto at = [y](int row) { return y + static_cast<std::ptrdiff_t>(row) * Lanes::kLanes; };
  std::array<Lanes, width> x;
  unrolled<width>([&](auto c) { x[c] = Lanes::load(at(block.column + c)); });
  for (int r = 0; r < block.n_below; ++r) {
    const Lanes row = Lanes::load(at(block.rows[r]));
    unrolled<width>([&](auto c) { x[c] = x[c] - Lanes::all(block.below(r, c)) * row; });
  }
  unrolled<width>([&](auto after) {
    constexpr int kColumn = width - 1 - after;
    Lanes& own = x[kColumn];
    unrolled<after>([&](auto k) {
      own = own - Lanes::all(block.triangle(kColumn + 1 + k, kColumn)) * x[kColumn + 1 + k];
    });
    own = own / Lanes::all(block.triangle(kColumn, kColumn));
    own.store(at(block.column + kColumn));
  });
}

/// Calls work(block) for columns j to j + width - 1.
template <class Work>
void with_block(const LowerColumns& L, int j, int width, Work work) {
  static_assert(kWidest == 4);
  switch (width) {
    case 1:
      return work(Block<1>(L, j));
    case 2:
      return work(Block<2>(L, j));
    case 3:
      return work(Block<3>(L, j));
    default:
      return work(Block<4>(L, j));
  }
}

}  // namespace

void ColumnSolve::prepare(const LowerColumns& L) {
  blocks_.clear();
  for (int j = 0; j < L.n; ++j) {
    const bool goes_on = j > 0 && j - blocks_.back() < kWidest &&
                         L.lengths[j] == L.lengths[j - 1] - 1 && L.rows[L.starts[j - 1] + 1] == j;
    if (!goes_on) blocks_.push_back(j);
  }
  blocks_.push_back(L.n);
}

void ColumnSolve::solve(const LowerColumns& L, const int* permutation,
                        const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                        Eigen::Ref<Eigen::MatrixXd> solution) {
  if (rhs.cols() == 1) return solve_lanes<One>(L, permutation, rhs, solution, 0);
  for (Eigen::Index c = 0; c < rhs.cols(); c += Four::kLanes)
    solve_lanes<Four>(L, permutation, rhs, solution, c);
}

template <class Lanes>
void ColumnSolve::solve_lanes(const LowerColumns& L, const int* permutation,
                              const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                              Eigen::Ref<Eigen::MatrixXd> solution, Eigen::Index first) {
  constexpr int kLanes = Lanes::kLanes;
  const auto n_used = static_cast<int>(std::min<Eigen::Index>(kLanes, rhs.cols() - first));
  rows_.assign(static_cast<std::size_t>(L.n) * kLanes, 0);
  for (int c = 0; c < n_used; ++c) {
    const double* const column = rhs.col(first + c).data();
    for (int i = 0; i < L.n; ++i)
      rows_[static_cast<std::size_t>(i * kLanes + c)] = column[permutation[i]];
  }
  double* const y = rows_.data();
  const std::size_t n_blocks = blocks_.size() - 1;
  for (std::size_t b = 0; b < n_blocks; ++b)
    with_block(L, blocks_[b], blocks_[b + 1] - blocks_[b],
               [y](const auto& block) { eliminate<Lanes>(block, y); });
  for (std::size_t b = n_blocks; b-- > 0;)
    with_block(L, blocks_[b], blocks_[b + 1] - blocks_[b],
               [y](const auto& block) { substitute<Lanes>(block, y); });
  for (int c = 0; c < n_used; ++c) {
    double* const column = solution.col(first + c).data();
    for (int i = 0; i < L.n; ++i)
      column[permutation[i]] = rows_[static_cast<std::size_t>(i * kLanes + c)];
  }
}

}  // namespace pleat
