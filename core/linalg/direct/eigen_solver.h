#pragma once

#include <memory>

#include "core/linalg/linear_solver.h"

namespace pleat {

/// Sparse Cholesky, A = P' L L' P, by Eigen's SimplicialLLT with AMD ordering: the second backend,
/// always there.
///
/// The residual is reported as 0. Eigen allocates in each factorisation; a repeated solve does not.
std::unique_ptr<LinearSolver> make_eigen_solver();

}  // namespace pleat
