#pragma once

#include "lstm_planner/grid_world/search/grid_path.hpp"

namespace lstm_planner {

/// Estimates of the length of a path between two cells from their distance in columns and rows alone (thesis
/// Eq. 1.2-1.5). A search is optimal with an estimate that is never too long (admissible).
enum class Heuristic {
  kManhattan,  ///< columns + rows. Not admissible with diagonal moves: up to sqrt(2) times too long
  kChebyshev,  ///< the larger of both: diagonal moves as if they cost 1. Admissible
  kOctile,     ///< exact if nothing is in the way. Admissible
  kEuclidean,  ///< the straight line. Admissible
  /// 25 times the straight line, "found to work better than any other configuration" (thesis 3.1). Not admissible
  kScaledEuclidean
};

/// Estimated cost between two cells if moves cost this. The Euclidean estimates do not use `costs` (Eq. 1.5);
/// Chebyshev's counts a diagonal as a straight move.
MoveCost estimateCost(Heuristic heuristic, CellIndex from, CellIndex to, const MoveCosts& costs = {});

}  // namespace lstm_planner
