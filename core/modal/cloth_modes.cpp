#include "core/modal/cloth_modes.h"

#include <string>

#include "core/base/check.h"
#include "core/model/system_matrix.h"

namespace pleat {
namespace {

/// Rows and columns of the matrix that are kept, in their order.
SparseMatrix kept_block(const SparseMatrix& lower, const std::vector<int>& index_of, int n_kept) {
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(static_cast<std::size_t>(lower.nonZeros()));
  for (int column = 0; column < lower.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
      const int row = index_of[static_cast<std::size_t>(entry.row())];
      const int kept_column = index_of[static_cast<std::size_t>(column)];
      if (row >= 0 && kept_column >= 0) entries.emplace_back(row, kept_column, entry.value());
    }
  SparseMatrix kept(n_kept, n_kept);
  kept.setFromTriplets(entries.begin(), entries.end());
  return kept;
}

}  // namespace

SolveReport cloth_modes(const ClothModel& model, const Positions& positions,
                        const std::vector<VertexId>& held, int count, Modes& modes) {
  const int n = model.n_vertices();
  PLEAT_CHECK(positions.cols() == n, "a place for each vertex");
  if (!model.hanging.empty())
    throw InputError("", "expected a cloth whose vertices all move for themselves; " +
                             std::to_string(model.hanging.size()) +
                             " of this one hang between others");
  std::vector<bool> is_held(static_cast<std::size_t>(n), false);
  for (const Pin& pin : model.pins) is_held[static_cast<std::size_t>(pin.vertex)] = true;
  for (const VertexId v : held) is_held[static_cast<std::size_t>(v)] = true;
  std::vector<int> index_of(3 * static_cast<std::size_t>(n), -1);
  int n_free = 0;
  for (std::size_t i = 0; i < index_of.size(); ++i)
    if (!is_held[i / 3]) index_of[i] = n_free++;
  if (count < 1 || count > n_free)
    throw InputError("", "expected 1 to " + std::to_string(n_free) +
                             " modes, at most one a free coordinate; found " +
                             std::to_string(count));
  const SparseMatrix stiffness =
      kept_block(stiffness_matrix(model, positions, ElementHessian::exact), index_of, n_free);
  Eigen::VectorXd masses(n_free);
  for (std::size_t i = 0; i < index_of.size(); ++i)
    if (index_of[i] >= 0) masses[index_of[i]] = model.masses[static_cast<Eigen::Index>(i / 3)];
  Modes free;
  SolveReport report = lowest_modes(stiffness, masses, Eigen::MatrixXd(n_free, 0), count, free);
  if (report.ends_run()) return report;
  modes = free;
  modes.shapes = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(n), free.size());
  for (std::size_t i = 0; i < index_of.size(); ++i)
    if (index_of[i] >= 0)
      modes.shapes.row(static_cast<Eigen::Index>(i)) = free.shapes.row(index_of[i]);
  return report;
}

// Modes are orthonormal in the masses: each has the square of its amplitude.
Eigen::VectorXd motion_shares(const Modes& modes, const Eigen::VectorXd& masses,
                              const Positions& about, const std::vector<Positions>& frames) {
  PLEAT_CHECK(modes.shapes.rows() == about.size() && masses.size() == about.cols(),
              "modes, masses and shape are of the same vertices");
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(modes.size());
  double whole = 0;
  for (const Positions& frame : frames) {
    PLEAT_CHECK(frame.cols() == about.cols(), "every frame has the same vertices");
    const Positions move = frame - about;
    const Positions weighted = move * masses.asDiagonal();
    squares += (modes.shapes.transpose() * flat(weighted)).cwiseAbs2();
    whole += flat(move).dot(flat(weighted));
  }
  if (!(whole > 0)) return Eigen::VectorXd::Zero(modes.size());
  for (Eigen::Index m = 1; m < squares.size(); ++m) squares[m] += squares[m - 1];
  return (squares / whole).cwiseMin(1);
}

}  // namespace pleat
