#include "core/linalg/finite_check.h"

#include <cmath>
#include <limits>

namespace pleat {
namespace {

/// v - v is zero for a finite v and NaN otherwise, so one sum without branches tells whether to
/// look closer.
bool all_finite(const double* values, Eigen::Index count) {
  double sum = 0;
  for (Eigen::Index k = 0; k < count; ++k) sum += values[k] - values[k];
  return sum == 0;
}

SolveReport not_finite(const std::string& message) {
  return {SolveStatus::not_finite, 0, std::numeric_limits<double>::quiet_NaN(), message};
}

}  // namespace

std::optional<SolveReport> report_not_finite(const SparseMatrix& lower) {
  if (all_finite(lower.valuePtr(), lower.nonZeros())) return std::nullopt;
  for (Eigen::Index column = 0; column < lower.cols(); ++column) {
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
      if (!std::isfinite(entry.value())) {
        return not_finite("matrix entry (" + std::to_string(entry.row()) + ", " +
                          std::to_string(column) + ") is not finite");
      }
    }
  }
  return std::nullopt;
}

std::optional<SolveReport> report_not_finite(const Eigen::Ref<const Eigen::MatrixXd>& columns,
                                             const char* what) {
  for (Eigen::Index column = 0; column < columns.cols(); ++column) {
    const double* values = columns.col(column).data();
    if (all_finite(values, columns.rows())) continue;
    for (Eigen::Index row = 0; row < columns.rows(); ++row) {
      if (!std::isfinite(values[row])) {
        return not_finite(std::string(what) + " (" + std::to_string(row) + ", " +
                          std::to_string(column) + ") is not finite");
      }
    }
  }
  return std::nullopt;
}

}  // namespace pleat
