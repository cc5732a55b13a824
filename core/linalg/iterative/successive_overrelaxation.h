#pragma once

#include <memory>

#include "core/linalg/linear_solver.h"

namespace pleat {

/// Successive over-relaxation on 3 x 3 blocks, one right-hand side after the other. The size of the
/// matrix is a multiple of 3.
///
///     x_i += omega D_i^-1 (b_i - sum_j A_ij x_j)      row by row, with the newest x
///
/// Rows are taken by colour: those of one colour have no block with each other. Stops at
/// |b - A x| <= tolerance |b|; reaching the cap is reported as not_converged with the last x. One
/// sweep takes a product's work. Without an omega in the options it follows from the spectral
/// radius rho of block Jacobi's iteration, which Lanczos' steps estimate with the first values
/// after `analyze`: with two colours it rises from 1 as Chebyshev's polynomials have it, to what it
/// is from the first sweep on otherwise, 2 / (1 + sqrt(1 - rho^2)).
///
/// Source: Young, Iterative solution of large linear systems, Academic Press 1971; Golub & Varga,
/// Numerische Mathematik 3 (1961) 147.
std::unique_ptr<LinearSolver> make_successive_overrelaxation(const SolverOptions& options);

}  // namespace pleat
