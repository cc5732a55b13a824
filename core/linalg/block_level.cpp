#include "core/linalg/block_level.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/linalg/float4.h"

namespace pleat {
namespace {

/// Inverse of a symmetric B x B matrix by its Cholesky factor. False unless all pivots are
/// positive.
template <int B>
bool invert(const double* S, double* inverse) {
  double V[B][B] = {};  // of S = C C': first C, then its inverse
  for (int c = 0; c < B; ++c) {
    for (int r = c; r < B; ++r) {
      double rest = S[r * B + c];
      for (int k = 0; k < c; ++k) rest -= V[r][k] * V[c][k];
      if (r == c && !(rest > 0)) return false;
      V[r][c] = r == c ? std::sqrt(rest) : rest / V[c][c];
    }
  }
  for (int c = 0; c < B; ++c) {
    V[c][c] = 1 / V[c][c];
    for (int r = c + 1; r < B; ++r) {
      double sum = 0;
      for (int k = c; k < r; ++k) sum += V[r][k] * V[k][c];
      V[r][c] = -sum / V[r][r];
    }
  }
  for (int r = 0; r < B; ++r) {
    for (int c = 0; c <= r; ++c) {
      double sum = 0;
      for (int k = r; k < B; ++k) sum += V[k][r] * V[k][c];
      inverse[r * B + c] = inverse[c * B + r] = sum;
    }
  }
  return true;
}

template <int B>
void invert_or_trace(const double* S, double* inverse) {
  if (invert<B>(S, inverse)) return;
  double trace = 0;
  for (int k = 0; k < B; ++k) trace += S[k * B + k];
  std::fill_n(inverse, B * B, 0.0);
  for (int k = 0; k < B; ++k) inverse[k * B + k] = trace > 0 ? 1 / trace : 1;
}

/// A row of a vector.
template <int B>
struct Row {
  static constexpr int kFours = kLanes<B> / 4;
  Float4 fours[kFours];

  static Row zero() { return Row{}; }
  static Row load(const float* from) {
    Row row;
    for (int h = 0; h < kFours; ++h) row.fours[h] = load4(from + 4 * h);
    return row;
  }
  void store(float* to) const {
    for (int h = 0; h < kFours; ++h) store4(to + 4 * h, fours[h]);
  }
  void add_multiple(float factor, const float* from) {
    for (int h = 0; h < kFours; ++h) fours[h] += factor * load4(from + 4 * h);
  }
};

/// Sums of B x B blocks times rows. Blocks are loaded beyond their end: x is zero there.
template <int B>
struct Products {
  Float4 sums[B] = {};

  void add(const float* block, const float* x) {
    const Row<B> row = Row<B>::load(x);
    for (int r = 0; r < B; ++r)
      for (int h = 0; h < Row<B>::kFours; ++h)
        sums[r] += load4(block + r * B + 4 * h) * row.fours[h];
  }
  float sum(int r) const { return (sums[r][0] + sums[r][1]) + (sums[r][2] + sums[r][3]); }
};

/// x = S b for a symmetric S in rows of kLanes<B>.
template <int B>
inline Row<B> solved(const float* S, const float* b) {
  Row<B> x = Row<B>::zero();
  for (int k = 0; k < B; ++k) x.add_multiple(b[k], S + k * kLanes<B>);
  return x;
}

}  // namespace

template <int B>
void BlockLevel<B>::set_pattern(LowerPattern pattern) {
  pattern_ = std::move(pattern);
  const auto n = static_cast<std::size_t>(n_rows());
  const std::size_t n_blocks = pattern_.columns.size();
  values_.assign((n + n_blocks) * kSize, 0.0);
  inverses_.assign(n * kSize, 0.0);
  low_.assign(n_blocks * kSize + kLoadRoom, 0.0F);
  solvers_.assign(n * B * kLanes<B>, 0.0F);
  for (std::vector<float>* vector : {&b_, &x_, &r_, &g_, &u_}) vector->assign(n * kLanes<B>, 0.0F);
}

template <int B>
void BlockLevel<B>::update() {
  for (int row = 0; row < n_rows(); ++row) {
    double* inverse = inverses_.data() + row * kSize;
    invert_or_trace<B>(diagonal(row), inverse);
    for (int r = 0; r < B; ++r)
      for (int c = 0; c < B; ++c)
        solvers_[place((row * B + r) * kLanes<B> + c)] = static_cast<float>(inverse[r * B + c]);
  }
  const std::size_t n_entries = low_.size() - kLoadRoom;
  const double* from = values_.data() + n_rows() * kSize;
  for (std::size_t k = 0; k < n_entries; ++k) low_[k] = static_cast<float>(from[k]);
}

// Forward, x_i = D_i^-1 (b_i - L_i x), of which u holds the part of later rows.
template <int B>
void BlockLevel<B>::sweep_forward() {
  for (int row = 0; row < n_rows(); ++row) {
    Products<B> products;
    for (int k = pattern_.begins[place(row)]; k < pattern_.begins[place(row) + 1]; ++k)
      products.add(low(k), x_.data() + pattern_.columns[place(k)] * kLanes<B>);
    const int at = row * kLanes<B>;
    float rest[B];
    for (int r = 0; r < B; ++r) {
      const auto entry = place(at + r);
      g_[entry] = b_[entry] - products.sum(r);
      rest[r] = g_[entry] - u_[entry];
    }
    solved<B>(solvers_.data() + row * B * kLanes<B>, rest).store(x_.data() + at);
  }
}

// Backward, x_i = D_i^-1 (g_i - u_i), where u gathers L'x as rows become known.
template <int B>
void BlockLevel<B>::sweep_backward() {
  std::fill(u_.begin(), u_.end(), 0.0F);
  for (int row = n_rows() - 1; row >= 0; --row) {
    const int at = row * kLanes<B>;
    float rest[B];
    for (int r = 0; r < B; ++r) rest[r] = g_[place(at + r)] - u_[place(at + r)];
    solved<B>(solvers_.data() + row * B * kLanes<B>, rest).store(x_.data() + at);
    for (int k = pattern_.begins[place(row)]; k < pattern_.begins[place(row) + 1]; ++k) {
      float* u = u_.data() + pattern_.columns[place(k)] * kLanes<B>;
      Row<B> sum = Row<B>::load(u);
      for (int r = 0; r < B; ++r) sum.add_multiple(x_[place(at + r)], low(k) + r * B);
      sum.store(u);
    }
  }
}

// What is left after the backward sweep: b - L x - D x - L'x = b - L x - g, as D x = g - u there.
template <int B>
void BlockLevel<B>::smooth_from_zero() {
  std::fill(u_.begin(), u_.end(), 0.0F);
  sweep_forward();
  sweep_backward();
  for (int row = 0; row < n_rows(); ++row) {
    Products<B> products;
    for (int k = pattern_.begins[place(row)]; k < pattern_.begins[place(row) + 1]; ++k)
      products.add(low(k), x_.data() + pattern_.columns[place(k)] * kLanes<B>);
    for (int r = 0; r < B; ++r) {
      const auto entry = place(row * kLanes<B> + r);
      r_[entry] = b_[entry] - g_[entry] - products.sum(r);
    }
  }
}

template <int B>
void BlockLevel<B>::smooth() {
  std::fill(u_.begin(), u_.end(), 0.0F);
  for (int row = 0; row < n_rows(); ++row) {
    const float* x = x_.data() + row * kLanes<B>;
    for (int k = pattern_.begins[place(row)]; k < pattern_.begins[place(row) + 1]; ++k) {
      float* u = u_.data() + pattern_.columns[place(k)] * kLanes<B>;
      Row<B> sum = Row<B>::load(u);
      for (int r = 0; r < B; ++r) sum.add_multiple(x[r], low(k) + r * B);
      sum.store(u);
    }
  }
  sweep_forward();
  sweep_backward();
}

template class BlockLevel<3>;
template class BlockLevel<6>;

}  // namespace pleat
