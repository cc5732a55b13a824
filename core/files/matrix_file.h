#pragma once

#include <Eigen/Core>
#include <string>

#include "core/linalg/sparse.h"

namespace pleat {

/// A symmetric matrix, given by its lower triangle, in Matrix Market's coordinate format, so that
/// other programs can check it. Stored zeros are kept. Source: Boisvert, Pozo & Remington, The
/// Matrix Market exchange formats, NISTIR 5935, 1996.
std::string matrix_market_text(const SparseMatrix& lower);

/// A diagonal matrix in the same format.
std::string matrix_market_text(const Eigen::VectorXd& diagonal);

}  // namespace pleat
