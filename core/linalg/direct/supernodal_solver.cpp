#include "core/linalg/direct/supernodal_solver.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/linalg/direct/supernodes.h"

namespace pleat {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Node = Supernodes::Node;
using Panel = Eigen::Map<MatrixXd>;
using ConstPanel = Eigen::Map<const MatrixXd>;

std::size_t square(int n) { return static_cast<std::size_t>(n) * static_cast<std::size_t>(n); }
std::size_t panel_size(const Node& node) {
  return static_cast<std::size_t>(node.n_rows) * static_cast<std::size_t>(node.n_columns);
}
/// Rows below a node's own columns, which its parent gets.
int n_behind(const Node& node) { return node.n_rows - node.n_columns; }

class SupernodalSolver final : public LinearSolver {
 public:
  void do_analyze(const SparseMatrix& lower) override {
    supernodes_ = find_supernodes(lower);
    place_entries(lower);
    place_panels();
    local_.assign(supernodes_.order.size(), 0);
  }

  SolveReport do_factorize(const SparseMatrix& lower) override {
    lower_ = lower;
    waiting_.clear();
    for (std::size_t k = 0; k < supernodes_.nodes.size(); ++k) {
      const Node& node = supernodes_.nodes[k];
      Panel front(front_.data(), node.n_rows, node.n_rows);
      gather(k, front);
      if (!eliminate(k, front))
        return {SolveStatus::not_positive_definite, 0, 0, "a pivot is not positive"};
      Panel(panels_.data() + panel_begins_[k], node.n_rows, node.n_columns) =
          front.leftCols(node.n_columns);
    }
    return {};
  }

  SolveReport do_solve(const Eigen::Ref<const MatrixXd>& rhs,
                       Eigen::Ref<MatrixXd> solution) override {
    const auto n = static_cast<Index>(supernodes_.order.size());
    ordered_.resize(n, rhs.cols());
    behind_.resize(largest_behind_, rhs.cols());
    for (Index k = 0; k < n; ++k) ordered_.row(k) = rhs.row(supernodes_.order[k]);
    for (std::size_t k = 0; k < supernodes_.nodes.size(); ++k) solve_lower(k);
    for (std::size_t k = supernodes_.nodes.size(); k-- > 0;) solve_upper(k);
    for (Index k = 0; k < n; ++k) solution.row(supernodes_.order[k]) = ordered_.row(k);
    if (!solution.allFinite()) return {SolveStatus::not_finite, 0, 0, "the solution is not finite"};
    SolveReport report;
    report.relative_residual = residual(rhs, solution);
    return report;
  }

 private:
  /// An entry of the matrix, by its place among the values, in a node's front.
  struct Entry {
    int source;
    int row;     // row of the factor
    int column;  // column of the node
  };

  /// Schur complement of a front, until its parent takes it.
  struct Waiting {
    std::size_t node;
    std::size_t begin;  // place in stack_
  };

  ConstPanel panel(std::size_t k) const {
    const Node& node = supernodes_.nodes[k];
    return {panels_.data() + panel_begins_[k], node.n_rows, node.n_columns};
  }
  const int* rows(const Node& node) const { return supernodes_.rows.data() + node.rows_begin; }

  std::size_t end_of(const Waiting& waiting) const {
    return waiting.begin + square(n_behind(supernodes_.nodes[waiting.node]));
  }

  void place_entries(const SparseMatrix& lower) {
    const std::vector<int>& order = supernodes_.order;
    std::vector<int> place(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = static_cast<int>(k);
    std::vector<std::size_t> node_of(order.size());
    for (std::size_t k = 0; k < supernodes_.nodes.size(); ++k) {
      const Node& node = supernodes_.nodes[k];
      std::fill_n(node_of.begin() + node.first, node.n_columns, k);
    }
    entries_.assign(supernodes_.nodes.size(), {});
    for (int column = 0; column < lower.cols(); ++column)
      for (int e = lower.outerIndexPtr()[column]; e < lower.outerIndexPtr()[column + 1]; ++e) {
        const auto [first, last] = std::minmax(place[column], place[lower.innerIndexPtr()[e]]);
        const std::size_t k = node_of[first];
        entries_[k].push_back({e, last, first - supernodes_.nodes[k].first});
      }
  }

  void place_panels() {
    panel_begins_.clear();
    largest_behind_ = 0;
    std::size_t size = 0;
    std::size_t largest_front = 0;
    std::size_t stack = 0;
    std::size_t largest_stack = 0;
    std::vector<std::size_t> left;  // sizes of what waits
    for (const Node& node : supernodes_.nodes) {
      panel_begins_.push_back(size);
      size += panel_size(node);
      largest_front = std::max(largest_front, square(node.n_rows));
      for (int child = 0; child < node.n_children; ++child) {
        stack -= left.back();
        left.pop_back();
      }
      if (n_behind(node) == 0) continue;
      largest_behind_ = std::max(largest_behind_, n_behind(node));
      left.push_back(square(n_behind(node)));
      stack += left.back();
      largest_stack = std::max(largest_stack, stack);
    }
    panels_.resize(size);
    front_.resize(largest_front);
    stack_.resize(largest_stack);
  }

  /// The lower triangle of node k's front: what the matrix and the children have there.
  void gather(std::size_t k, Panel& front) {
    const Node& node = supernodes_.nodes[k];
    for (int row = 0; row < node.n_rows; ++row) local_[rows(node)[row]] = row;
    for (int column = 0; column < node.n_rows; ++column)
      front.col(column).tail(node.n_rows - column).setZero();
    for (const Entry& entry : entries_[k])
      front(local_[entry.row], entry.column) += lower_.valuePtr()[entry.source];
    for (int child = 0; child < node.n_children; ++child) {
      const Node& from = supernodes_.nodes[waiting_.back().node];
      const int n = n_behind(from);
      const ConstPanel update(stack_.data() + waiting_.back().begin, n, n);
      const int* behind = rows(from) + from.n_columns;
      for (int column = 0; column < n; ++column) {
        double* to = front.data() + front.rows() * Index{local_[behind[column]]};
        for (int row = column; row < n; ++row) to[local_[behind[row]]] += update(row, column);
      }
      waiting_.pop_back();
    }
  }

  /// Eliminates node k's columns and leaves what is behind them on the stack. False where a pivot
  /// is not positive.
  bool eliminate(std::size_t k, Panel& front) {
    const Node& node = supernodes_.nodes[k];
    Eigen::Ref<MatrixXd> own = front.topLeftCorner(node.n_columns, node.n_columns);
    if (Eigen::LLT<Eigen::Ref<MatrixXd>>(own).info() != Eigen::Success) return false;
    const int n = n_behind(node);
    if (n == 0) return true;
    auto below = front.bottomLeftCorner(n, node.n_columns);
    auto rest = front.bottomRightCorner(n, n);
    own.transpose().triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(below);
    rest.selfadjointView<Eigen::Lower>().rankUpdate(below, -1);

    const std::size_t begin = waiting_.empty() ? 0 : end_of(waiting_.back());
    Panel update(stack_.data() + begin, n, n);
    for (int column = 0; column < n; ++column)
      update.col(column).tail(n - column) = rest.col(column).tail(n - column);
    waiting_.push_back({k, begin});
    return true;
  }

  void solve_lower(std::size_t k) {
    const Node& node = supernodes_.nodes[k];
    const ConstPanel L = panel(k);
    auto own = ordered_.middleRows(node.first, node.n_columns);
    L.topRows(node.n_columns).triangularView<Eigen::Lower>().solveInPlace(own);
    auto behind = behind_.topRows(n_behind(node));
    behind.noalias() = L.bottomRows(n_behind(node)) * own;
    for (int row = 0; row < n_behind(node); ++row)
      ordered_.row(rows(node)[node.n_columns + row]) -= behind.row(row);
  }

  void solve_upper(std::size_t k) {
    const Node& node = supernodes_.nodes[k];
    const ConstPanel L = panel(k);
    auto own = ordered_.middleRows(node.first, node.n_columns);
    auto behind = behind_.topRows(n_behind(node));
    for (int row = 0; row < n_behind(node); ++row)
      behind.row(row) = ordered_.row(rows(node)[node.n_columns + row]);
    own.noalias() -= L.bottomRows(n_behind(node)).transpose() * behind;
    L.topRows(node.n_columns).transpose().triangularView<Eigen::Upper>().solveInPlace(own);
  }

  /// The largest of the right-hand sides'.
  double residual(const Eigen::Ref<const MatrixXd>& rhs, const Eigen::Ref<MatrixXd>& solution) {
    ordered_ = rhs;
    ordered_.noalias() -= lower_.selfadjointView<Eigen::Lower>() * solution;
    double largest = 0;
    for (Index column = 0; column < rhs.cols(); ++column)
      if (const double size = rhs.col(column).norm(); size > 0)
        largest = std::max(largest, ordered_.col(column).norm() / size);
    return largest;
  }

  SparseMatrix lower_;  // matrix last factorised
  Supernodes supernodes_;
  std::vector<std::vector<Entry>> entries_;  // entries of each node
  std::vector<std::size_t> panel_begins_;    // panel of each node, in panels_
  std::vector<double> panels_;               // L
  std::vector<double> front_;
  std::vector<double> stack_;
  std::vector<Waiting> waiting_;
  std::vector<int> local_;  // row of the factor -> row of the front at hand
  MatrixXd ordered_;        // n x m, in the order of elimination
  int largest_behind_ = 0;
  MatrixXd behind_;  // part of one node, largest_behind_ x m
};

}  // namespace

std::unique_ptr<LinearSolver> make_supernodal_solver() {
  return std::make_unique<SupernodalSolver>();
}

}  // namespace pleat
