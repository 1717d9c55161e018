#include "lstm_planner/grid_world/search/heuristic.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "lstm_planner/grid/grid_rays.hpp"

namespace lstm_planner {
namespace {

/// Rounded down, so that rounding never makes it too long.
MoveCost straightLine(MoveCost columns, MoveCost rows, double scale) {
  const double cells = std::sqrt(static_cast<double>(columns * columns + rows * rows));
  return static_cast<MoveCost>(scale * static_cast<double>(kStraightCost) * cells);
}

}  // namespace

void checkHeuristic(const HeuristicParameters& heuristic) {
  if (heuristic.scale >= 0.0 && heuristic.scale <= kLargestEuclideanScale) return;
  throw std::invalid_argument("the heuristic's scale is " + std::to_string(heuristic.scale) +
                              ", expected a number from 0 to " + std::to_string(kLargestEuclideanScale));
}

MoveCost estimateCost(const HeuristicParameters& heuristic, CellIndex from, CellIndex to, const MoveCosts& costs) {
  const MoveCost columns = std::abs(from.column - to.column);
  const MoveCost rows = std::abs(from.row - to.row);
  const OctileSteps steps(columns, rows);
  switch (heuristic.kind) {
    case Heuristic::kManhattan:
      return costs.straight * (columns + rows);
    case Heuristic::kChebyshev:
      return costs.straight * std::max(columns, rows);
    case Heuristic::kOctile:
      return costs.straight * steps.straight + costs.diagonal * steps.diagonal;
    case Heuristic::kEuclidean:
      return straightLine(columns, rows, 1.0);
    case Heuristic::kScaledEuclidean:
      return straightLine(columns, rows, heuristic.scale);
  }
  return 0;
}

}  // namespace lstm_planner
