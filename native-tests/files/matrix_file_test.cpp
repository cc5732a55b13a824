#include "core/files/matrix_file.h"

#include <catch2/catch.hpp>
#include <vector>

#include "core/base/check.h"
#include "core/base/random.h"
#include "native-tests/support/matrix_market.h"

namespace pleat {
namespace {

/// The lower triangle with random entries at random places, a stored zero among them.
SparseMatrix random_lower(int n, Random& random) {
  std::vector<Eigen::Triplet<double>> entries{{n - 1, 0, 0.0}};
  for (int row = 0; row < n; ++row)
    for (int column = 0; column <= row; ++column)
      if (random.below(3) == 0) entries.emplace_back(row, column, random.uniform(-1e5, 1e5));
  SparseMatrix lower(n, n);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

}  // namespace

TEST_CASE("matrix file: a lower triangle is written in Matrix Market's coordinate format",
          "[files]") {
  SparseMatrix lower(2, 2);
  lower.insert(0, 0) = 2;
  lower.insert(1, 0) = -1.0 / 3;
  lower.insert(1, 1) = 4;
  lower.makeCompressed();
  CHECK(matrix_market_text(lower) ==
        "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2.0\n2 1 "
        "-0.3333333333333333\n2 2 4.0\n");
}

TEST_CASE("matrix file: a diagonal is written as a matrix", "[files]") {
  CHECK(matrix_market_text(Eigen::VectorXd(Eigen::Vector2d(0.5, 1e-7))) ==
        "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 0.5\n2 2 1e-07\n");
}

TEST_CASE("matrix file: a matrix is read back to the bit, stored zeros too", "[files]") {
  const int n = GENERATE(1, 2, 9, 40);
  CAPTURE(n);
  Random random(static_cast<std::uint64_t>(n));
  const SparseMatrix lower = random_lower(n, random);
  const SparseMatrix again = read_matrix_market(matrix_market_text(lower));
  CHECK(again.nonZeros() == lower.nonZeros());
  CHECK(Eigen::MatrixXd(again) == Eigen::MatrixXd(lower));
}

TEST_CASE("matrix file: comments, blanks and line ends of other writers are read", "[files]") {
  const SparseMatrix lower = read_matrix_market(
      "%%MatrixMarket matrix coordinate real symmetric\r\n% by hand\n%\n 2  2 1 \r\n2 1\t3e-1\r\n");
  CHECK(lower.coeff(1, 0) == 0.3);
  CHECK(lower.nonZeros() == 1);
}

TEST_CASE("matrix file: what is not such a matrix is refused with its line", "[files]") {
  const std::string header = "%%MatrixMarket matrix coordinate real symmetric\n";
  const auto refused_at = [](const std::string& text) -> std::string {
    try {
      read_matrix_market(text);
      return "nowhere";
    } catch (const InputError& error) {
      return error.where();
    }
  };
  CHECK(refused_at("") == "line 1");
  CHECK(refused_at("%%MatrixMarket matrix array real general\n2 2\n") == "line 1");
  CHECK(refused_at(header) == "line 2");
  CHECK(refused_at(header + "2 3 1\n1 1 1\n") == "line 2");
  CHECK(refused_at(header + "2 2 2\n1 1 1\n") == "line 4");
  CHECK(refused_at(header + "2 2 1\n1 2 1\n") == "line 3");
  CHECK(refused_at(header + "2 2 1\n3 1 1\n") == "line 3");
  CHECK(refused_at(header + "2 2 1\n1 1 nan\n") == "line 3");
  CHECK(refused_at(header + "2 2 1\n1 1 1 1\n") == "line 3");
}

}  // namespace pleat
