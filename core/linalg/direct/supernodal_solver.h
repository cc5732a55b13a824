#pragma once

#include <memory>

#include "core/linalg/linear_solver.h"

namespace pleat {

/// Sparse Cholesky, A = P' L L' P, of whole groups of columns at a time: several times as fast as
/// one after the other on meshes of tens of thousands of vertices.
///
/// The multifrontal method: the rows of a group (supernodes.h) are a dense front, to which the
/// matrix and the group's children add; its columns are eliminated, and what is left of it waits
/// for its parent. It keeps L and the largest front, and as much again of what waits. Dense
/// products may allocate. The residual is computed. Source: Duff & Reid, The multifrontal solution
/// of indefinite sparse symmetric linear equations, ACM TOMS 9, 1983.
std::unique_ptr<LinearSolver> make_supernodal_solver();

}  // namespace pleat
