#include "native-tests/support/matrix_market.h"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "core/base/check.h"
#include "core/files/json_text.h"

namespace pleat {
namespace {

constexpr const char* kHeader = "%%MatrixMarket matrix coordinate real symmetric";

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
