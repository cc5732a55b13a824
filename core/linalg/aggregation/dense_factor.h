#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pleat {

/// Cholesky factor of a small dense symmetric matrix, by rows. Unknowns whose pivot is lost in
/// rounding are taken to be zero, so that what it solves is positive semidefinite in any case.
class DenseFactor {
 public:
  /// Zeros of a size.
  void resize(int size);
  int size() const { return size_; }
  /// Entry of the matrix, to be filled on and below the diagonal before `compute`.
  double& entry(int row, int column) { return values_[place(row, column)]; }
  void set_zero() { std::fill(values_.begin(), values_.end(), 0.0); }
  void compute();
  /// Solves in place.
  void solve(double* x) const;

 private:
  std::size_t place(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(size_) +
           static_cast<std::size_t>(column);
  }

  int size_ = 0;
  std::vector<double> values_;
};

}  // namespace pleat
