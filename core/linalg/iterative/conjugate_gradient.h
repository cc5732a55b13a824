#pragma once

#include <memory>

#include "core/linalg/linear_solver.h"

namespace pleat {

/// Conjugate gradients on 3 x 3 blocks, one right-hand side after the other, preconditioned by an
/// incomplete factor or by multigrid. The size of the matrix is a multiple of 3.
///
/// The automatic choice begins with the incomplete factor. If that takes more than 60 iterations,
/// multigrid goes on from there and begins in the next 15 factorisations. Where its single
/// precision makes it indefinite, the incomplete factor goes on until the next `analyze`.
///
/// Stops at |b - A x| <= tolerance |b|; reaching the cap is reported as not_converged with the last
/// x. The report's iterations are the sum over the right-hand sides, its residual is the largest.
/// The residual is the updated one; below a tolerance of 1e-8 it is computed afresh before success
/// is reported. A matrix that is not positive definite is noticed in a diagonal block by factorize,
/// otherwise by solve once a direction p has p'Ap <= 0. Source: Hestenes & Stiefel, Methods of
/// conjugate gradients for solving linear systems, J. Res. NBS 49, 1952.
std::unique_ptr<LinearSolver> make_conjugate_gradient(const SolverOptions& options);

}  // namespace pleat
