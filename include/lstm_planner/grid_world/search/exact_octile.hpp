#pragma once

#include <cstdint>

#include "lstm_planner/grid/grid_rays.hpp"
#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// Octile distance between two cells, as its numbers of straight and diagonal steps, so that distances can be compared
/// exactly: sums with sqrt(2) in floating point may differ where the distances are equal.
struct OctileDistance {
  std::int64_t straight = 0;
  std::int64_t diagonal = 0;

  /// In cells.
  double length() const { return lengthOfMoves(straight, diagonal); }
};

inline OctileDistance octileDistance(CellIndex a, CellIndex b) {
  const OctileSteps steps(std::int64_t{a.column} - b.column, std::int64_t{a.row} - b.row);
  return {steps.straight, steps.diagonal};
}

inline bool operator==(OctileDistance a, OctileDistance b) {
  return a.straight == b.straight && a.diagonal == b.diagonal;
}

/// Exact for distances below 2^30 steps.
inline bool operator<(OctileDistance a, OctileDistance b) {
  // a < b where (a.straight - b.straight) < (b.diagonal - a.diagonal) sqrt(2); squares with the sign kept are ordered
  // like the numbers themselves.
  const auto signed_square = [](std::int64_t x) { return x < 0 ? -x * x : x * x; };
  return signed_square(a.straight - b.straight) < 2 * signed_square(b.diagonal - a.diagonal);
}

}  // namespace lstm_planner
