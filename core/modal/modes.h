#pragma once

#include "core/linalg/solve_report.h"
#include "core/linalg/sparse.h"
#include "core/modal/tet_mesh.h"

namespace pleat {

/// Shapes that swing alone: K phi = lambda M phi, by ascending lambda, those of zero stiffness
/// first.
struct Modes {
  Eigen::MatrixXd shapes;     ///< one per column, phi' M phi = 1 each and 0 between two
  Eigen::VectorXd stiffness;  ///< lambda: the square of the angular frequency [1/s^2]
  Eigen::VectorXd residuals;  ///< |K phi - lambda M phi| / (|K| |phi|), |K| its largest row sum
  int n_rigid = 0;            ///< how many of the first are of the given null space

  Eigen::Index size() const { return shapes.cols(); }
};

/// True where a mode's stiffness is next to nothing beside the largest of them: rounding tells
/// whether it is above or below zero.
bool is_costless(const Modes& modes, Eigen::Index mode);

/// The lowest modes of a system of n unknowns.
///
/// stiffness   n x n, by its lower triangle [N/m]; where it is indefinite, the lowest lambda are
///             negative
/// masses      of each unknown [kg], positive
/// null_space  n x k, independent columns that span all that the stiffness does not resist
/// count       modes beside these, at most n - k
/// modes       set, unless the report ends the run
///
/// Reports not_converged with the modes so far where the iteration met its cap, and what stopped
/// the factor where that failed.
///
/// Source: Lehoucq, Sorensen & Yang, ARPACK users' guide, SIAM 1998 (shift-invert mode).
SolveReport lowest_modes(const SparseMatrix& stiffness, const Eigen::VectorXd& masses,
                         const Eigen::MatrixXd& null_space, int count, Modes& modes);

/// The six rigid motions of each part, which the vertices' numbers from 0 tell, at these positions:
/// 3 n x 6 parts, independent, not normalised.
Eigen::MatrixXd rigid_motions(const Positions& positions, const std::vector<int>& part_of_vertex);

}  // namespace pleat
