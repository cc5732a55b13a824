#include "core/files/matrix_file.h"

#include <cmath>

#include "core/base/check.h"
#include "core/files/json_text.h"

namespace pleat {
namespace {

constexpr const char* kHeader = "%%MatrixMarket matrix coordinate real symmetric";

std::string size_line(Eigen::Index n, Eigen::Index n_entries) {
  return std::string(kHeader) + '\n' + std::to_string(n) + ' ' + std::to_string(n) + ' ' +
         std::to_string(n_entries) + '\n';
}

/// Counted from one, as the format does; 17 digits or fewer give the same bits back.
std::string entry_line(Eigen::Index row, Eigen::Index column, double value) {
  PLEAT_CHECK(std::isfinite(value), "a matrix entry is finite");
  return std::to_string(row + 1) + ' ' + std::to_string(column + 1) + ' ' + Json(value).dump() +
         '\n';
}

}  // namespace

std::string matrix_market_text(const SparseMatrix& lower) {
  PLEAT_CHECK(lower.rows() == lower.cols(), "a symmetric matrix is square");
  std::string text = size_line(lower.rows(), lower.nonZeros());
  for (Eigen::Index column = 0; column < lower.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
      PLEAT_CHECK(entry.row() >= entry.col(), "only the lower triangle is stored");
      text += entry_line(entry.row(), entry.col(), entry.value());
    }
  }
  return text;
}

std::string matrix_market_text(const Eigen::VectorXd& diagonal) {
  std::string text = size_line(diagonal.size(), diagonal.size());
  for (Eigen::Index row = 0; row < diagonal.size(); ++row)
    text += entry_line(row, row, diagonal[row]);
  return text;
}

}  // namespace pleat
