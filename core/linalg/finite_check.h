#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/linalg/solve_report.h"
#include "core/linalg/sparse.h"

namespace pleat {

/// Report of status not_finite naming the first entry of the matrix that is NaN or infinite, if
/// there is one.
std::optional<SolveReport> report_not_finite(const SparseMatrix& lower);

/// Report on right-hand sides that are not finite (`what` names them in the message).
std::optional<SolveReport> report_not_finite(const Eigen::Ref<const Eigen::MatrixXd>& columns,
                                             const char* what);

}  // namespace pleat
