#include "core/linalg/aggregation/dense_factor.h"

#include <cmath>

namespace pleat {
namespace {

/// A pivot that keeps less of its diagonal entry has lost its digits.
constexpr double kLeastDensePivot = 1e-12;

}  // namespace

void DenseFactor::resize(int size) {
  size_ = size;
  values_.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 0.0);
}

// A lost pivot is kept as 0, which `solve` reads as a row and column that are not there.
void DenseFactor::compute() {
  for (int r = 0; r < size_; ++r) {
    double* row = values_.data() + place(r, 0);
    const double whole = row[r];
    for (int c = 0; c <= r; ++c) {
      const double* other = values_.data() + place(c, 0);
      double rest = row[c];
      for (int k = 0; k < c; ++k) rest -= row[k] * other[k];
      if (c < r)
        row[c] = other[c] > 0 ? rest / other[c] : 0;
      else
        row[c] = rest > kLeastDensePivot * whole ? std::sqrt(rest) : 0;
    }
  }
}

void DenseFactor::solve(double* x) const {
  for (int r = 0; r < size_; ++r) {
    const double* row = values_.data() + place(r, 0);
    for (int k = 0; k < r; ++k) x[r] -= row[k] * x[k];
    x[r] = row[r] > 0 ? x[r] / row[r] : 0;
  }
  for (int r = size_ - 1; r >= 0; --r) {
    const double* row = values_.data() + place(r, 0);
    x[r] = row[r] > 0 ? x[r] / row[r] : 0;
    for (int k = 0; k < r; ++k) x[k] -= row[k] * x[r];
  }
}

}  // namespace pleat
