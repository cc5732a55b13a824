#include "core/linalg/orthonormal.h"

#include <Eigen/QR>
#include <catch2/catch.hpp>

using namespace pleat;

TEST_CASE("orthonormal: of random columns as Householder's reflections have it") {
  std::srand(3);
  const Eigen::MatrixXd columns = Eigen::MatrixXd::Random(40, 7);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  Eigen::MatrixXd expected = qr.householderQ() * Eigen::MatrixXd::Identity(40, 7);
  for (Eigen::Index j = 0; j < 7; ++j)
    if (expected.col(j).dot(columns.col(j)) < 0) expected.col(j) *= -1;
  CHECK((orthonormal_in_order(columns) - expected).norm() < 1e-13);
}

TEST_CASE("orthonormal: columns that nearly coincide still give right angles") {
  constexpr double kApart = 1e-9;
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(6, 5);
  columns.row(0).setOnes();
  for (Eigen::Index j = 0; j < 5; ++j) columns(j + 1, j) = kApart;
  const Eigen::MatrixXd base = orthonormal_in_order(columns);
  CHECK((base.transpose() * base - Eigen::MatrixXd::Identity(5, 5)).norm() < 1e-14);
  CHECK((columns - base * (base.transpose() * columns)).norm() < 1e-15);
}

TEST_CASE("orthonormal: what depends on the columns before becomes zero, no columns are none") {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(4, 4);
  columns.col(1) *= -3;
  columns.col(2).setZero();
  columns(0, 3) = 2;
  const Eigen::MatrixXd base = orthonormal_in_order(columns);
  CHECK((base.col(0).array() - 0.5).abs().maxCoeff() < 1e-15);
  CHECK(base.middleCols<2>(1).isZero(0));
  CHECK(base.col(3).norm() == Approx(1));
  CHECK(orthonormal_in_order(Eigen::MatrixXd(4, 0)).size() == 0);
}
