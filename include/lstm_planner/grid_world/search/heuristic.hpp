#pragma once

#include "lstm_planner/grid_world/search/grid_path.hpp"

namespace lstm_planner {

/// Estimates of the length of a path between two cells from their distance in columns and rows alone (thesis
/// Eq. 1.2-1.5). A search is optimal with an estimate that is never too long (admissible).
enum class Heuristic {
  kManhattan,       ///< columns + rows. Not admissible where diagonal moves are: up to sqrt(2) times too long
  kChebyshev,       ///< the larger of both: diagonal moves as if they cost 1. Admissible
  kOctile,          ///< exact where nothing is in the way. Admissible
  kEuclidean,       ///< the straight line. Admissible
  kScaledEuclidean  ///< the straight line times a scale. Not admissible for a scale above 1
};

/// "Found to work better than any other configuration" (thesis 3.1).
constexpr double kThesisEuclideanScale = 25.0;

/// Scales above would let sums of costs overflow on the largest grids.
constexpr double kLargestEuclideanScale = 1000.0;

/// A heuristic and its scale.
struct HeuristicParameters {
  Heuristic kind = Heuristic::kOctile;
  double scale = kThesisEuclideanScale;  ///< of kScaledEuclidean
};

/// Throws std::invalid_argument for a scale that is not from 0 to kLargestEuclideanScale.
void checkHeuristic(const HeuristicParameters& heuristic);

/// Estimated cost between two cells where moves cost this: the Euclidean ones take no notice, as Eq. 1.5, Chebyshev's
/// takes a diagonal for a straight move. `heuristic` must have passed checkHeuristic().
MoveCost estimateCost(const HeuristicParameters& heuristic, CellIndex from, CellIndex to, const MoveCosts& costs = {});

}  // namespace lstm_planner
