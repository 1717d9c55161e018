#include "lstm_planner/base/grid/grid_rays.hpp"

#include <cmath>

namespace lstm_planner {

std::array<double, kGridRayCount> gridRays(const OccupancyGrid& grid, CellIndex cell) {
  std::array<double, kGridRayCount> ranges{};
  for (std::size_t ray = 0; ray < ranges.size(); ++ray) {
    const CellIndex step = kGridRaySteps[ray];
    int steps = 1;
    while (steps < kGridRayCap &&
           grid.at({cell.column + steps * step.column, cell.row + steps * step.row}) == Cell::kFree) {
      ++steps;
    }
    ranges[ray] = steps * (step.column != 0 && step.row != 0 ? M_SQRT2 : 1.0);
  }
  return ranges;
}

}  // namespace lstm_planner
