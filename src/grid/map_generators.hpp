#pragma once

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// Throws std::invalid_argument for sides below `shortest` and for more cells than a grid holds.
void checkMapSize(int columns, int rows, int shortest);

/// Blocks every cell that is not of the largest region. Regions are connected by sides: without corner cutting a
/// diagonal move needs both cells at its side, and so reaches nothing more.
void keepLargestRegion(PassableGrid* grid);

}  // namespace lstm_planner
