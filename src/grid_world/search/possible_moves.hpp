#pragma once

#include <array>
#include <cstddef>

#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// What movePossible() says of all eight moves, from which of the eight cells around are passable. The inner loops of
/// the searches look at every cell once.
inline std::array<bool, kGridMoveCount> possibleMoves(const std::array<bool, kGridMoveCount>& passable_around,
                                                      CornerCutting corner_cutting) {
  std::array<bool, kGridMoveCount> possible = passable_around;
  if (corner_cutting == CornerCutting::kAllowed) return possible;
  for (std::size_t diagonal = 1; diagonal < possible.size(); diagonal += 2) {
    possible[diagonal] =
        passable_around[diagonal] && passable_around[diagonal - 1] && passable_around[(diagonal + 1) % kGridMoveCount];
  }
  return possible;
}

}  // namespace lstm_planner
