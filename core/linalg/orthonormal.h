#pragma once

#include <Eigen/Core>

namespace pleat {

/// Columns with an orthonormal base of what the columns before them and they span, each to the side
/// of its own column: Gram-Schmidt, each column made orthogonal twice, which is enough (Giraud,
/// Langou & Rozloznik, Computers & Mathematics with Applications 50 (2005) 1069).
///
/// columns  [n x k]; one that depends on those before it, but for rounding, or is zero becomes zero
Eigen::MatrixXd orthonormal_in_order(const Eigen::MatrixXd& columns);

}  // namespace pleat
