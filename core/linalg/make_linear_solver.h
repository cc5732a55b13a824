#pragma once

#include <memory>

#include "core/linalg/linear_solver.h"

namespace pleat {

/// False for cholmod where SuiteSparse's source could not be had when this was built.
bool is_available(SolverKind kind);

/// The direct solver to prefer: cholmod where there is one, else eigen.
SolverKind best_direct_solver();

/// cg and sor work on 3 x 3 blocks: n must be a multiple of 3.
/// Throws ContractError when the kind is not available.
std::unique_ptr<LinearSolver> make_linear_solver(SolverKind kind,
                                                 const SolverOptions& options = {});

}  // namespace pleat
