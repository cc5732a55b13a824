#pragma once

#include <memory>

#include "core/linalg/linear_solver.h"

namespace pleat {

/// Sparse Cholesky, A = P' L L' P, by CHOLMOD in its simplicial form with AMD ordering. Not in the
/// library where SuiteSparse was not found; see is_available.
///
/// The residual is not computed and reported as 0. CHOLMOD allocates a few arrays of its own in
/// each factorisation, none in a repeated solve (docs/methods/linear_solvers.md). Source: Chen,
/// Davis, Hager & Rajamanickam, Algorithm 887: CHOLMOD, ACM Trans. Math. Software 35(3), 2008.
std::unique_ptr<LinearSolver> make_cholmod_solver();

}  // namespace pleat
