#pragma once

#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// The moves that walls beside a cell leave, both with bit d for direction d.
inline unsigned movesBetween(unsigned walls, CornerCutting corner_cutting) {
  constexpr unsigned kDiagonals = 0xaa;
  unsigned blocked = walls;
  if (corner_cutting == CornerCutting::kForbidden) {
    blocked |= (walls << 1 | walls >> 7 | walls >> 1 | walls << 7) & kDiagonals;
  }
  return ~blocked & 0xff;
}

}  // namespace lstm_planner
