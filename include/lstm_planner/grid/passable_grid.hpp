#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lstm_planner/grid/cell_field.hpp"
#include "lstm_planner/grid/grid_rays.hpp"

namespace lstm_planner {

/// The passable cells of an ASCII map. Row 0 is the first line of the file, column 0 its first letter. Lengths are in
/// cells. Cells outside are not passable.
class PassableGrid : public CellField<std::uint8_t> {
 public:
  static constexpr std::int64_t kMostCells = std::int64_t{1} << 26;

  PassableGrid() = default;
  /// Throws std::invalid_argument for a size that is not positive or for more than kMostCells.
  PassableGrid(int columns, int rows, bool passable);

  bool passable(CellIndex cell) const { return at(cell, 0) != 0; }
  /// `cell` must be inside.
  void set(CellIndex cell, bool passable) { (*this)[cell] = passable ? 1 : 0; }
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

/// Length of so many moves, cells; rounded once, however many there are.
inline double lengthOfMoves(std::int64_t straight, std::int64_t diagonal) {
  return static_cast<double>(straight) + moveLength(1) * static_cast<double>(diagonal);
}

/// Whether a move from `cell` to its neighbour in that direction is possible.
bool movePossible(const PassableGrid& grid, CellIndex cell, int direction, CornerCutting corner_cutting);

/// What the agent of the thesis senses (Eq. 3.1): the number of steps to the first cell that is not passable, in the
/// order of kGridRaySteps. It is 1 if the neighbour is blocked, and at most kGridRayCap. Diagonal steps count 1, not
/// sqrt(2). A diagonal ray passes between two blocked cells that touch only at a corner.
using GridRanges = std::array<std::uint8_t, kGridRayCount>;

/// The same as above, from the sensed ranges.
bool movePossible(const GridRanges& ranges, int direction, CornerCutting corner_cutting);

}  // namespace lstm_planner
