#include "lstm_planner/grid_world/agent/rolling_grid.hpp"

#include <algorithm>

namespace lstm_planner {

RollingGrid::RollingGrid() : bytes_(static_cast<std::size_t>(kSide * kRowBytes + 1), 0) {}

void RollingGrid::clear() {
  std::fill(bytes_.begin(), bytes_.end(), std::uint8_t{0});
  placed_ = false;
}

bool RollingGrid::observe(const GridObservation& observation) {
  const auto firstOf = [&](int middle) {
    const int first = middle - kSide / 2;
    return first - ((first % kRollStep) + kRollStep) % kRollStep;
  };
  const CellIndex cell = observation.cell;
  const bool far = cell.column - origin_.column < kSide / 2 - kRollStep ||
                   cell.column - origin_.column >= kSide / 2 + kRollStep ||
                   cell.row - origin_.row < kSide / 2 - kRollStep || cell.row - origin_.row >= kSide / 2 + kRollStep;
  if (!placed_ || far) roll({firstOf(cell.column), firstOf(cell.row)});
  bool is_new = false;
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    const int range = observation.ranges[static_cast<std::size_t>(direction)];
    if (range >= kGridRayCap) continue;
    const CellIndex step = kGridRaySteps[static_cast<std::size_t>(direction)];
    const CellIndex end{cell.column + range * step.column, cell.row + range * step.row};
    if (!contains(end) || isWall(end)) continue;
    const int column = end.column - origin_.column;
    bytes_[byteOf(column, end.row - origin_.row)] |= static_cast<std::uint8_t>(1u << (column % kByteBits));
    is_new = true;
  }
  return is_new;
}

void RollingGrid::roll(CellIndex origin) {
  const int columns = (origin.column - origin_.column) / kByteBits;
  const int rows = origin.row - origin_.row;
  // In the direction of the shift, so that nothing is overwritten before it has been read.
  for (int i = 0; placed_ && i < kSide; ++i) {
    const int row = rows >= 0 ? i : kSide - 1 - i;
    for (int j = 0; j < kRowBytes; ++j) {
      const int byte = columns >= 0 ? j : kRowBytes - 1 - j;
      const int old_row = row + rows;
      const int old_byte = byte + columns;
      const bool was_inside = old_row >= 0 && old_row < kSide && old_byte >= 0 && old_byte < kRowBytes;
      bytes_[static_cast<std::size_t>(row * kRowBytes + byte)] =
          was_inside ? bytes_[static_cast<std::size_t>(old_row * kRowBytes + old_byte)] : std::uint8_t{0};
    }
  }
  origin_ = origin;
  placed_ = true;
}

}  // namespace lstm_planner
