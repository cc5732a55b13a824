#pragma once

#include <span>

#include "core/base/vec.h"
#include "core/linalg/sparse.h"

namespace pleat {

/// The translation t of all free vertices for which x + t is nearest to the solution of A x = b in
/// the norm of A. What an iterative solver left of b has no sum over the free vertices then: no
/// momentum is made or lost by how far it came.
///
/// lower     of A, in 3x3 blocks, which is positive definite; free vertices have no entries with
///           others
/// rhs       b, one column a vertex
/// solution  x, the same
/// is_free   for each vertex whether it moves along; zero is returned where none does
///
/// Source: Galerkin projection onto the translations, docs/methods/implicit.md.
Vec3 best_translation(const SparseMatrix& lower, const PositionsView& rhs,
                      const PositionsView& solution, std::span<const char> is_free);

}  // namespace pleat
