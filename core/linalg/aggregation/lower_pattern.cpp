#include "core/linalg/aggregation/lower_pattern.h"

namespace pleat {

void LowerPattern::find_columns() {
  column_begins.assign(begins.size(), 0);
  for (const int column : columns) ++column_begins[place(column) + 1];
  for (int row = 0; row < n_rows(); ++row)
    column_begins[place(row) + 1] += column_begins[place(row)];
  std::vector<int> next = column_begins;
  column_blocks.resize(columns.size());
  column_rows.resize(columns.size());
  for (int row = 0; row < n_rows(); ++row) {
    for (int k = begins[place(row)]; k < begins[place(row) + 1]; ++k) {
      const auto at = place(next[place(columns[place(k)])]++);
      column_blocks[at] = k;
      column_rows[at] = row;
    }
  }
}

}  // namespace pleat
