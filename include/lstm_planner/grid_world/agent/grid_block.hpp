#pragma once

#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// Cells along the side of a block, the unit in which an agent remembers a whole area.
constexpr int kBlockSide = 4;

constexpr int blockAlong(int cell) { return cell >> 2; }
static_assert(kBlockSide == 1 << 2 && blockAlong(-1) == -1 && blockAlong(-5) == -2, "rounded down");
/// The block that a cell lies in.
constexpr CellIndex blockOf(CellIndex cell) { return {blockAlong(cell.column), blockAlong(cell.row)}; }
/// Lowest column and row.
constexpr CellIndex firstCellOf(CellIndex block) { return {block.column * kBlockSide, block.row * kBlockSide}; }

}  // namespace lstm_planner
