#pragma once

#include <memory>

#include "core/linalg/linear_solver.h"

namespace pleat {

/// Successive over-relaxation on 3 x 3 blocks, one right-hand side after the other. The size of the
/// matrix is a multiple of 3.
///
///     x_i += omega D_i^-1 (b_i - sum_j A_ij x_j)      row by row, with the newest x
///
/// Stops at |b - A x| <= tolerance |b|; reaching the cap is reported as not_converged with the last
/// x. One sweep takes a product's work, and tells the residual. Without an omega in the options it
/// is the best for a consistently ordered matrix, 2 / (1 + sqrt(1 - rho^2)), with the spectral
/// radius rho of block Jacobi's iteration from a few power iterations with the first values after
/// `analyze`.
///
/// Source: Young, Iterative solution of large linear systems, Academic Press 1971.
std::unique_ptr<LinearSolver> make_successive_overrelaxation(const SolverOptions& options);

}  // namespace pleat
