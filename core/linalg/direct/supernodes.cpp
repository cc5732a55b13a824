#include "core/linalg/direct/supernodes.h"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace pleat {
namespace {

using Lists = std::vector<std::vector<int>>;

void sort_once_each(std::vector<int>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// Columns that stand side by side with the same neighbours, such as the three of a vertex, are one
/// variable of the elimination.
struct Variables {
  std::vector<int> begins;  // columns of the matrix, one more than there are variables
  Lists neighbours;         // others, ascending

  int count() const { return static_cast<int>(begins.size()) - 1; }
  int size(int variable) const { return begins[variable + 1] - begins[variable]; }
};

/// A number for each column that says which rows it has in the whole matrix. Where two columns of
/// different rows get the same one by chance, their variable has the rows of both.
std::vector<std::uint64_t> fingerprints(const SparseMatrix& lower) {
  const auto mixed = [](int index) {
    std::uint64_t bits = static_cast<std::uint64_t>(index) + 0x9e3779b97f4a7c15;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
    return bits ^ (bits >> 31);
  };
  std::vector<std::uint64_t> prints(static_cast<std::size_t>(lower.cols()));
  for (int column = 0; column < lower.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
      const auto row = static_cast<int>(entry.row());
      prints[column] += mixed(row);
      if (row != column) prints[row] += mixed(column);
    }
  return prints;
}

Variables find_variables(const SparseMatrix& lower) {
  const std::vector<std::uint64_t> prints = fingerprints(lower);
  Variables variables;
  std::vector<int> variable_of(prints.size());
  for (int column = 0; column < lower.cols(); ++column) {
    if (column == 0 || prints[column] != prints[column - 1]) variables.begins.push_back(column);
    variable_of[column] = static_cast<int>(variables.begins.size()) - 1;
  }
  variables.begins.push_back(static_cast<int>(lower.cols()));
  variables.neighbours.resize(static_cast<std::size_t>(variables.count()));
  for (int column = 0; column < lower.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
      const int a = variable_of[column];
      const int b = variable_of[entry.row()];
      if (a == b) continue;
      variables.neighbours[a].push_back(b);
      variables.neighbours[b].push_back(a);
    }
  for (std::vector<int>& list : variables.neighbours) sort_once_each(list);
  return variables;
}

std::vector<int> minimum_degree_order(const Variables& variables) {
  const int n = variables.count();
  SparseMatrix graph(n, n);
  std::vector<int> counts(static_cast<std::size_t>(n));
  for (int v = 0; v < n; ++v) counts[v] = static_cast<int>(variables.neighbours[v].size()) + 1;
  graph.reserve(counts);
  for (int v = 0; v < n; ++v) {
    graph.insert(v, v) = 1;
    for (const int other : variables.neighbours[v]) graph.insert(other, v) = 1;
  }
  graph.makeCompressed();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(graph, permutation);
  const auto& indices = permutation.indices();
  return {indices.data(), indices.data() + n};
}

/// The elimination tree of variables in an order: who is eliminated next among those that an
/// elimination joins.
struct EliminationTree {
  Lists earlier;            // neighbours of each, by their places in the order
  std::vector<int> parent;  // -1 of a root
};

EliminationTree elimination_tree(const Variables& variables, const std::vector<int>& order) {
  const int n = variables.count();
  std::vector<int> place(order.size());
  for (int k = 0; k < n; ++k) place[order[k]] = k;
  EliminationTree tree{Lists(order.size()), std::vector<int>(order.size(), -1)};
  std::vector<int> ancestor(order.size(), -1);  // shortcut towards the root
  for (int k = 0; k < n; ++k) {
    for (const int other : variables.neighbours[order[k]])
      if (place[other] < k) tree.earlier[k].push_back(place[other]);
    for (int at : tree.earlier[k])
      while (at != -1 && at < k) {
        const int next = std::exchange(ancestor[at], k);
        if (next == -1) tree.parent[at] = k;
        at = next;
      }
  }
  return tree;
}

/// Postorder of the elimination tree: the same elimination, each variable right behind its
/// descendants.
std::vector<int> postordered(const std::vector<int>& order, const std::vector<int>& parent) {
  const auto n = static_cast<int>(order.size());
  Lists children(order.size());
  std::vector<int> open;  // variables to be visited, the next one last
  for (int k = n - 1; k >= 0; --k)
    if (parent[k] < 0)
      open.push_back(k);
    else
      children[parent[k]].push_back(k);
  std::vector<int> places;
  while (!open.empty()) {
    const int k = open.back();
    if (children[k].empty()) {
      places.push_back(order[k]);
      open.pop_back();
    } else {
      open.push_back(children[k].back());
      children[k].pop_back();
    }
  }
  return places;
}

/// How many numbers each variable's columns have in the factor, from the first one's diagonal on.
std::vector<int> column_lengths(const Variables& variables, const std::vector<int>& order,
                                const EliminationTree& tree) {
  const auto n = static_cast<int>(order.size());
  std::vector<int> lengths(order.size());
  std::vector<int> seen(order.size(), -1);
  for (int row = 0; row < n; ++row) {
    const int size = variables.size(order[row]);
    lengths[row] += size;
    seen[row] = row;
    for (int at : tree.earlier[row])
      for (; seen[at] != row; at = tree.parent[at]) {
        seen[at] = row;
        lengths[at] += size;
      }
  }
  return lengths;
}

/// Variables whose columns become one node.
struct Group {
  int first, end;  // places in the order
  double n_columns;
  double n_rows;
  double n_zeros;  // zeros of its trapezium that the factor does not have

  double area() const { return n_columns * n_rows - n_columns * (n_columns - 1) / 2; }
};

/// Zeros are worth it where they save small products: of a few columns always, of many hardly. The
/// bounds are about those of CHOLMOD's supernodes, its columns being a vertex's three.
bool is_worthwhile(const Group& group) {
  struct Bound {
    double n_columns;  // largest number of columns
    double share;      // limit for the share of zeros
  };
  constexpr std::array<Bound, 3> kBounds = {{{12, 2}, {48, 0.5}, {144, 0.15}}};
  constexpr double kShareOfMany = 0.05;
  const double share = group.n_zeros / group.area();
  for (const Bound& bound : kBounds)
    if (group.n_columns <= bound.n_columns) return share < bound.share;
  return share < kShareOfMany;
}

Group joined(const Group& child, const Group& parent) {
  Group both{child.first, parent.end, child.n_columns + parent.n_columns,
             child.n_columns + parent.n_rows, 0};
  both.n_zeros = both.area() - (child.area() - child.n_zeros) - (parent.area() - parent.n_zeros);
  return both;
}

/// Each group with the last of its children where that is worth it, from the leaves on.
std::vector<Group> find_groups(const Variables& variables, const std::vector<int>& order,
                               const EliminationTree& tree) {
  const std::vector<int> lengths = column_lengths(variables, order, tree);
  std::vector<Group> groups;
  for (int k = 0; k < static_cast<int>(order.size()); ++k) {
    Group group{k, k + 1, static_cast<double>(variables.size(order[k])),
                static_cast<double>(lengths[k]), 0};
    while (!groups.empty() && tree.parent[groups.back().end - 1] == k) {
      const Group both = joined(groups.back(), group);
      if (!is_worthwhile(both)) break;
      group = both;
      groups.pop_back();
    }
    groups.push_back(group);
  }
  return groups;
}

/// Places in the order of the variables that a group's columns have entries of, behind it.
std::vector<int> rows_behind(const Group& group, const Lists& later, const Lists& of_children) {
  std::vector<int> rows;
  const auto add = [&](const std::vector<int>& places) {
    for (const int place : places)
      if (place >= group.end) rows.push_back(place);
  };
  for (int k = group.first; k < group.end; ++k) add(later[k]);
  for (const std::vector<int>& places : of_children) add(places);
  sort_once_each(rows);
  return rows;
}

}  // namespace

Supernodes find_supernodes(const SparseMatrix& lower) {
  const Variables variables = find_variables(lower);
  std::vector<int> order = minimum_degree_order(variables);
  order = postordered(order, elimination_tree(variables, order).parent);
  const EliminationTree tree = elimination_tree(variables, order);
  const auto n = static_cast<int>(order.size());

  Supernodes result;
  std::vector<int> columns{0};  // first column of the factor for each place in the order
  Lists later(order.size());
  for (int k = 0; k < n; ++k) {
    for (int c = 0; c < variables.size(order[k]); ++c)
      result.order.push_back(variables.begins[order[k]] + c);
    columns.push_back(static_cast<int>(result.order.size()));
    for (const int earlier : tree.earlier[k]) later[earlier].push_back(k);
  }

  std::vector<Lists> of_children(order.size());  // rows of children, by the next row's place
  for (const Group& group : find_groups(variables, order, tree)) {
    Lists below;
    for (int k = group.first; k < group.end; ++k)
      for (std::vector<int>& places : of_children[k]) below.push_back(std::move(places));
    std::vector<int> behind = rows_behind(group, later, below);

    const int rows_begin = static_cast<int>(result.rows.size());
    const auto append = [&](int place) {
      for (int column = columns[place]; column < columns[place + 1]; ++column)
        result.rows.push_back(column);
    };
    for (int k = group.first; k < group.end; ++k) append(k);
    for (const int place : behind) append(place);
    result.nodes.push_back({columns[group.first], columns[group.end] - columns[group.first],
                            rows_begin, static_cast<int>(result.rows.size()) - rows_begin,
                            static_cast<int>(below.size())});
    if (!behind.empty()) of_children[behind.front()].push_back(std::move(behind));
  }
  return result;
}

}  // namespace pleat
