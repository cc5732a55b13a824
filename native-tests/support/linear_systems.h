#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/random.h"
#include "core/linalg/sparse.h"

namespace pleat {

/// The lower triangle of a symmetric matrix; entries that are zero are left out.
SparseMatrix lower_of(const Eigen::MatrixXd& dense);

/// The symmetric matrix of a lower triangle.
Eigen::MatrixXd full_of(const SparseMatrix& lower);

/// Uniform in [-1, 1).
Eigen::MatrixXd random_columns(Eigen::Index rows, Eigen::Index columns, Random& random);

/// Five-point grid of side x side vertices with a random positive definite 3 x 3 block on each edge
/// and a multiple of the identity on the diagonal: the shape of an implicit cloth step.
SparseMatrix grid_system(int side, std::uint64_t seed);

/// System of any graph, its edges pairs of vertices.
SparseMatrix graph_system(int n_vertices, const std::vector<std::array<int, 2>>& edges,
                          std::uint64_t seed);

/// R R' + I with a third of the 3 x 3 blocks of R present, none of them symmetric.
SparseMatrix random_system(int n_blocks, std::uint64_t seed);

}  // namespace pleat
