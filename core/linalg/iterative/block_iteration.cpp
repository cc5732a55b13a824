#include "core/linalg/iterative/block_iteration.h"

#include <algorithm>
#include <cmath>

#include "core/linalg/finite_check.h"

namespace pleat {

double BlockIteration::norm(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum);
}

void BlockIteration::gather(const double* from, std::vector<double>& to) const {
  if (ordered() != nullptr)
    ordered()->gather(from, to.data());
  else
    std::copy(from, from + to.size(), to.begin());
}

SolveReport BlockIteration::do_solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                                     Eigen::Ref<Eigen::MatrixXd> solution) {
  if (auto report = report_not_finite(solution, "starting guess")) return *report;
  b_.resize(static_cast<std::size_t>(rhs.rows()));
  x_.resize(b_.size());
  SolveReport total;
  for (Eigen::Index column = 0; column < rhs.cols(); ++column) {
    gather(rhs.col(column).data(), b_);
    gather(solution.col(column).data(), x_);
    SolveReport report;
    const double b_norm = norm(b_);
    if (b_norm > 0)
      report = solve_column(b_norm);
    else
      std::fill(x_.begin(), x_.end(), 0.0);
    if (ordered() != nullptr)
      ordered()->scatter(x_.data(), solution.col(column).data());
    else
      std::copy(x_.begin(), x_.end(), solution.col(column).data());
    total.iterations += report.iterations;
    total.relative_residual = std::max(total.relative_residual, report.relative_residual);
    if (!report.ok() && total.ok()) {
      total.status = report.status;
      total.message = report.message;
    }
  }
  return total;
}

}  // namespace pleat
