#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/base/random.h"
#include "core/linalg/sparse.h"

namespace pleat {

/// The lower triangle of a symmetric matrix; entries that are zero are left out.
SparseMatrix lower_of(const Eigen::MatrixXd& dense);

/// The symmetric matrix of a lower triangle.
Eigen::MatrixXd full_of(const SparseMatrix& lower);

/// Uniform in [-1, 1).
Eigen::MatrixXd random_columns(Eigen::Index rows, Eigen::Index columns, Random& random);

/// Five-point grid of side x side vertices with a random positive definite block on each edge and a
/// multiple of the identity on the diagonal: the shape of an implicit cloth step.
SparseMatrix grid_system(int side, int block_size, std::uint64_t seed);

/// R R' + I with a third of the blocks of R present, none of them symmetric.
SparseMatrix random_system(int n_blocks, int block_size, std::uint64_t seed);

}  // namespace pleat
