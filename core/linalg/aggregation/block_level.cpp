#include "core/linalg/aggregation/block_level.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/base/simd.h"

namespace pleat {
namespace {

/// C and V = C^-1 of S = C C', lower triangles by rows. False unless all pivots are positive.
template <int B>
bool find_roots(const double* S, double* C, double* V) {
  std::fill_n(C, B * B, 0.0);
  std::fill_n(V, B * B, 0.0);
  for (int c = 0; c < B; ++c) {
    for (int r = c; r < B; ++r) {
      double rest = S[r * B + c];
      for (int k = 0; k < c; ++k) rest -= C[r * B + k] * C[c * B + k];
      if (r == c && !(rest > 0)) return false;
      C[r * B + c] = r == c ? std::sqrt(rest) : rest / C[c * B + c];
    }
  }
  for (int c = 0; c < B; ++c) {
    V[c * B + c] = 1 / C[c * B + c];
    for (int r = c + 1; r < B; ++r) {
      double sum = 0;
      for (int k = c; k < r; ++k) sum += C[r * B + k] * V[k * B + c];
      V[r * B + c] = -sum / C[r * B + r];
    }
  }
  return true;
}

template <int B>
void find_roots_or_trace(const double* S, double* C, double* V) {
  if (find_roots<B>(S, C, V)) return;
  double trace = 0;
  for (int k = 0; k < B; ++k) trace += S[k * B + k];
  const double root = trace > 0 ? std::sqrt(trace) : 1;
  std::fill_n(C, B * B, 0.0);
  std::fill_n(V, B * B, 0.0);
  for (int k = 0; k < B; ++k) {
    C[k * B + k] = root;
    V[k * B + k] = 1 / root;
  }
}

/// V A W' in the place of A, for lower triangles V and W.
template <int B>
inline void scale_block(const double* V, const double* W, double* A) {
  double product[B * B];
  for (int r = 0; r < B; ++r) {
    for (int c = 0; c < B; ++c) {
      double sum = 0;
      for (int k = 0; k <= r; ++k) sum += V[r * B + k] * A[k * B + c];
      product[r * B + c] = sum;
    }
  }
  for (int r = 0; r < B; ++r) {
    for (int c = 0; c < B; ++c) {
      double sum = 0;
      for (int k = 0; k <= c; ++k) sum += product[r * B + k] * W[c * B + k];
      A[r * B + c] = sum;
    }
  }
}

/// A row of a vector.
template <int B>
struct Row {
  static constexpr int kFours = kLanes<B> / 4;
  Float4 fours[kFours];

  static Row zero() { return Row{}; }
  static Row load(const float* from) {
    Row row;
    for (int h = 0; h < kFours; ++h) row.fours[h] = Float4::load(from + 4 * h);
    return row;
  }
  void store(float* to) const {
    for (int h = 0; h < kFours; ++h) fours[h].store(to + 4 * h);
  }
  void add_multiple(float factor, const float* from) {
    for (int h = 0; h < kFours; ++h)
      fours[h] = fours[h] + Float4::all(factor) * Float4::load(from + 4 * h);
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
        sums[r] = sums[r] + Float4::load(block + r * B + 4 * h) * row.fours[h];
  }
  float sum(int r) const { return sum_of_lanes<float>(sums[r]); }
};

}  // namespace

template <int B>
void BlockLevel<B>::set_pattern(LowerPattern pattern) {
  pattern_ = std::move(pattern);
  const auto n = static_cast<std::size_t>(n_rows());
  const std::size_t n_blocks = pattern_.columns.size();
  values_.assign((n + n_blocks) * kSize, 0.0);
  roots_.assign(n * kSize, 0.0);
  inverse_roots_.assign(n * kSize, 0.0);
  low_.assign(n_blocks * kSize + kLoadRoom, 0.0F);
  for (std::vector<float>* vector : {&b_, &x_, &r_, &g_, &u_}) vector->assign(n * kLanes<B>, 0.0F);
}

template <int B>
void BlockLevel<B>::scale() {
  for (int row = 0; row < n_rows(); ++row) {
    double* V = inverse_roots_.data() + row * kSize;
    find_roots_or_trace<B>(diagonal(row), roots_.data() + row * kSize, V);
    scale_block<B>(V, V, diagonal(row));
    for (int k = pattern_.begins[place(row)]; k < pattern_.begins[place(row) + 1]; ++k) {
      scale_block<B>(V, inverse_root(pattern_.columns[place(k)]), lower(k));
      for (int e = 0; e < kSize; ++e) low_[place(k * kSize + e)] = static_cast<float>(lower(k)[e]);
    }
  }
}

// Forward, x_i = b_i - L_i x - u_i, of which u holds the part of later rows.
template <int B>
void BlockLevel<B>::sweep_forward() {
  for (int row = 0; row < n_rows(); ++row) {
    Products<B> products;
    for (int k = pattern_.begins[place(row)]; k < pattern_.begins[place(row) + 1]; ++k)
      products.add(low(k), x_.data() + pattern_.columns[place(k)] * kLanes<B>);
    const auto at = place(row * kLanes<B>);
    for (std::size_t r = 0; r < B; ++r) {
      g_[at + r] = b_[at + r] - products.sum(static_cast<int>(r));
      x_[at + r] = g_[at + r] - u_[at + r];
    }
  }
}

// Backward, x_i = g_i - u_i, where u gathers L'x as rows become known.
template <int B>
void BlockLevel<B>::sweep_backward() {
  std::fill(u_.begin(), u_.end(), 0.0F);
  for (int row = n_rows() - 1; row >= 0; --row) {
    const auto at = place(row * kLanes<B>);
    for (std::size_t r = 0; r < B; ++r) x_[at + r] = g_[at + r] - u_[at + r];
    for (int k = pattern_.begins[place(row)]; k < pattern_.begins[place(row) + 1]; ++k) {
      float* u = u_.data() + pattern_.columns[place(k)] * kLanes<B>;
      Row<B> sum = Row<B>::load(u);
      for (int r = 0; r < B; ++r) sum.add_multiple(x_[at + place(r)], low(k) + r * B);
      sum.store(u);
    }
  }
}

// b - L x - x - L'x = b - L x - g, as x = g - L'x after the backward sweep.
template <int B>
void BlockLevel<B>::find_residual() {
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
void BlockLevel<B>::smooth_from_zero() {
  std::fill(u_.begin(), u_.end(), 0.0F);
  sweep_forward();
  sweep_backward();
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
