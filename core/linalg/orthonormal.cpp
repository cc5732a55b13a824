#include "core/linalg/orthonormal.h"

namespace pleat {

Eigen::MatrixXd orthonormal_in_order(const Eigen::MatrixXd& columns) {
  constexpr double kDependent = 1e-14;  // share of a column's length
  Eigen::MatrixXd base(columns.rows(), columns.cols());
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    const auto before = base.leftCols(j);
    Eigen::VectorXd own = columns.col(j);
    const double length = own.norm();
    for (int turn = 0; turn < 2; ++turn) own -= before * (before.transpose() * own).eval();
    if (own.norm() > kDependent * length)
      base.col(j) = own.normalized();
    else
      base.col(j).setZero();
  }
  return base;
}

}  // namespace pleat
