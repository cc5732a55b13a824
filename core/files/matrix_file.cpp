#include "core/files/matrix_file.h"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <vector>

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

/// Reads numbers of a line and refuses anything after them.
class Line {
 public:
  Line(const std::string& text, int number) : rest_(text.c_str()), number_(number) {}

  Eigen::Index integer(Eigen::Index low, Eigen::Index high) {
    char* end = nullptr;
    const long long value = std::strtoll(rest_, &end, 10);
    if (end == rest_ || value < low || value > high)
      fail("a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    rest_ = end;
    return static_cast<Eigen::Index>(value);
  }

  double number() {
    char* end = nullptr;
    const double value = std::strtod(rest_, &end);
    if (end == rest_ || !std::isfinite(value)) fail("a finite number");
    rest_ = end;
    return value;
  }

  void finish() const {
    for (const char* c = rest_; *c != '\0'; ++c)
      if (*c != ' ' && *c != '\r' && *c != '\t') fail("the end of the line");
  }

  [[noreturn]] void fail(const std::string& expected) const {
    throw InputError("line " + std::to_string(number_),
                     "expected " + expected + ", got " + abbreviated(Json(std::string(rest_))));
  }

 private:
  const char* rest_;
  int number_;
};

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

SparseMatrix read_matrix_market(const std::string& text) {
  constexpr Eigen::Index kLargestSize = 100000000;
  std::istringstream lines(text);
  std::string line;
  int number = 1;
  std::getline(lines, line);
  if (line.rfind(kHeader, 0) != 0) Line(line, number).fail(kHeader);
  do {
    std::getline(lines, line);
    ++number;
  } while (lines && !line.empty() && line[0] == '%');
  Line sizes(line, number);
  const Eigen::Index n = sizes.integer(0, kLargestSize);
  if (sizes.integer(0, kLargestSize) != n) sizes.fail("as many columns as rows");
  const Eigen::Index n_entries = sizes.integer(0, kLargestSize);
  sizes.finish();
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index k = 0; k < n_entries; ++k) {
    line.clear();
    std::getline(lines, line);
    Line entry(line, ++number);
    const auto row = static_cast<int>(entry.integer(1, n) - 1);
    const auto column = static_cast<int>(entry.integer(1, row + 1) - 1);
    const double value = entry.number();
    entry.finish();
    entries.emplace_back(row, column, value);
  }
  SparseMatrix lower(n, n);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

}  // namespace pleat
