#pragma once

#include <cstddef>
#include <vector>

#include "core/model/cloth_model.h"

namespace pleat {

/// Rows whose work along the row is interleaved. Along a row every operation waits for the one
/// before it; four rows hide that wait.
constexpr int kPanelRows = 4;

/// The place of each vertex in arrays that are computed with four floats at a time.
///
/// The sheet is cut into rows of equal rest coordinate, the row nearest to the pins first. A row of
/// m vertices is cut into four equal pieces of `stride` columns, and one group of four floats holds
/// the same column of each piece: column c is lane c / stride of group c mod stride. Neighbours
/// then are whole groups apart, lane by lane, so that four constraints between them are computed
/// together without moving data between lanes. Only where one piece ends and the next begins does a
/// neighbour lie in another lane, and there a group shifted by one float serves.
///
/// Without rest coordinates, or where these are no grid, the whole cloth is one row in index order.
/// Unused places are padding, before the first group and after the last one too, so that a shifted
/// group stays inside.
struct LaneLayout {
  struct Place {
    int row = 0;
    int column = 0;
    int slot = 0;  ///< index into the arrays
  };
  std::vector<Place> places;  ///< one per vertex
  int stride = 0;             ///< columns per piece
  int n_rows = 0;
  int n_slots = 0;  ///< a multiple of 4, padding included

  int row_slots() const { return 4 * stride; }
  /// Floats from one array to the next in memory: an odd number of cache lines. At a multiple of
  /// 4096 bytes a load would wait for stores to the other arrays.
  std::size_t pitch() const {
    constexpr std::size_t kFloatsPerLine = 16;
    const std::size_t lines =
        (static_cast<std::size_t>(n_slots) + kFloatsPerLine - 1) / kFloatsPerLine;
    return (lines | 1) * kFloatsPerLine;
  }
};

/// Allocates; meant for once per model.
LaneLayout lane_layout(const ClothModel& model);

}  // namespace pleat
