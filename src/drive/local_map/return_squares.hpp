#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// From places in the base frame to keyOf() their squares in a window. Numbers are squares.
struct SquareFrame {
  float cosine;  ///< of the yaw, in squares a metre
  float sine;
  float x;  ///< the base in a frame in which all returns have positive coordinates
  float y;
  int first_column;  ///< of that frame's square (0, 0)
  int first_row;
  int sides;       ///< columns and rows that there are
  float farthest;  ///< m^2; what is farther has no key
};

/// Keys of the squares of some places, in order, once where several places follow one another in a square. `keys` is
/// overwritten.
void findSquares(const SquareFrame& frame, const std::vector<Point2>& places, std::vector<std::uint32_t>* keys);

}  // namespace lstm_planner
