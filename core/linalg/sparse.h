#pragma once

#include <Eigen/SparseCore>

namespace pleat {

/// Symmetric matrices are held by their lower triangle, column by column, compressed.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

}  // namespace pleat
