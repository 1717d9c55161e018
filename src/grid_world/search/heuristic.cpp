#include "lstm_planner/grid_world/search/heuristic.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lstm_planner/grid/grid_rays.hpp"

namespace lstm_planner {
namespace {

constexpr double kThesisScale = 25.0;

/// Rounded down, so that rounding never makes it too long.
MoveCost straightLine(MoveCost columns, MoveCost rows, double scale) {
  const double cells = std::sqrt(static_cast<double>(columns * columns + rows * rows));
  return static_cast<MoveCost>(scale * static_cast<double>(kStraightCost) * cells);
}

}  // namespace

MoveCost estimateCost(Heuristic heuristic, CellIndex from, CellIndex to, const MoveCosts& costs) {
  const MoveCost columns = std::abs(from.column - to.column);
  const MoveCost rows = std::abs(from.row - to.row);
  const OctileSteps steps(columns, rows);
  switch (heuristic) {
    case Heuristic::kManhattan:
      return costs.straight * (columns + rows);
    case Heuristic::kChebyshev:
      return costs.straight * std::max(columns, rows);
    case Heuristic::kOctile:
      return costs.straight * steps.straight + costs.diagonal * steps.diagonal;
    case Heuristic::kEuclidean:
      return straightLine(columns, rows, 1.0);
    case Heuristic::kScaledEuclidean:
      return straightLine(columns, rows, kThesisScale);
  }
  return 0;
}

}  // namespace lstm_planner
