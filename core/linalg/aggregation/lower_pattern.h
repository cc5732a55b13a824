#pragma once

#include <cstddef>
#include <vector>

namespace pleat {

/// A number of a row or block as the index into an array of them.
inline std::size_t place(int number) { return static_cast<std::size_t>(number); }

/// Pattern of the blocks of a symmetric block matrix below its diagonal, by rows and by columns:
/// the edges of a graph of its rows.
struct LowerPattern {
  std::vector<int> begins{0};  ///< first block of each row; one more than there are rows
  std::vector<int> columns;    ///< columns of the blocks, ascending in a row
  /// The blocks of each column, and their rows, ascending.
  std::vector<int> column_begins, column_blocks, column_rows;

  int n_rows() const { return static_cast<int>(begins.size()) - 1; }
  /// Once begins and columns are there.
  void find_columns();
};

}  // namespace pleat
