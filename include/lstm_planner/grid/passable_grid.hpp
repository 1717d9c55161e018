#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/grid/grid_rays.hpp"
#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// The passable cells of an ASCII map. Row 0 is the first line of the file, column 0 its first letter. Lengths are in
/// cells. Cells outside are not passable.
class PassableGrid {
 public:
  static constexpr std::int64_t kMostCells = std::int64_t{1} << 26;

  PassableGrid() = default;
  /// Throws std::invalid_argument for a size that is not positive or for more than kMostCells.
  PassableGrid(int columns, int rows, bool passable);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  CellRange cells() const { return {columns_, rows_}; }
  bool contains(CellIndex cell) const {
    return cell.column >= 0 && cell.row >= 0 && cell.column < columns_ && cell.row < rows_;
  }
  bool passable(CellIndex cell) const { return contains(cell) && cells_[offset(cell)] != 0; }
  /// `cell` must be inside.
  void set(CellIndex cell, bool passable) { cells_[offset(cell)] = passable ? 1 : 0; }

  std::size_t size() const { return cells_.size(); }
  /// Index of a cell inside in vectors of size() values.
  std::size_t offset(CellIndex cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(cell.column);
  }

 private:
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint8_t> cells_;
};

/// Whether a diagonal move may pass beside a blocked cell. The MovingAI benchmark does not allow it; the thesis does.
enum class CornerCutting { kForbidden, kAllowed };

/// Moves have the numbers of the rays: kGridRaySteps[direction]. Odd directions are diagonal.
constexpr int kGridMoveCount = kGridRayCount;

/// The cell so many steps ahead in a direction.
inline CellIndex alongRay(CellIndex cell, std::size_t direction, int steps) {
  const CellIndex step = kGridRaySteps[direction];
  return {cell.column + steps * step.column, cell.row + steps * step.row};
}

inline CellIndex cellBeside(CellIndex cell, int direction) {
  return alongRay(cell, static_cast<std::size_t>(direction), 1);
}

/// Length of a move, 1 or sqrt(2), cells.
inline double moveLength(int direction) { return direction % 2 == 0 ? 1.0 : 1.4142135623730951; }

/// Whether a move from `cell` to its neighbour in that direction is possible.
bool movePossible(const PassableGrid& grid, CellIndex cell, int direction, CornerCutting corner_cutting);

/// What the agent of the thesis senses (Eq. 3.1): the number of steps to the first cell that is not passable, in the
/// order of kGridRaySteps. It is 1 if the neighbour is blocked, and at most kGridRayCap. Diagonal steps count 1, not
/// sqrt(2). A diagonal ray passes between two blocked cells that touch only at a corner.
using GridRanges = std::array<std::uint8_t, kGridRayCount>;

/// The same as above, from the sensed ranges.
bool movePossible(const GridRanges& ranges, int direction, CornerCutting corner_cutting);

}  // namespace lstm_planner
