#include "lstm_planner/grid/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {
namespace {

constexpr double kMostCells = 268435456.0;  // 2^28

/// Far points and NaN must not overflow an int: they land in a cell that no grid has.
int cellNumber(double coordinate) {
  constexpr double kFar = 1e9;
  if (std::isnan(coordinate)) return -static_cast<int>(kFar);
  return static_cast<int>(std::clamp(std::floor(coordinate), -kFar, kFar));
}

}  // namespace

OccupancyGrid::OccupancyGrid(int columns, int rows, double resolution, Pose2 origin, Cell fill)
    : resolution_(resolution), origin_(origin) {
  if (columns <= 0 || rows <= 0 || static_cast<double>(columns) * rows > kMostCells) {
    throw std::invalid_argument("the grid has " + std::to_string(columns) + " x " + std::to_string(rows) +
                                " cells, expected positive sizes and at most 2^28 cells");
  }
  if (!(resolution > 0.0) || !std::isfinite(resolution)) {
    throw std::invalid_argument("the grid's resolution is " + numberText(resolution) +
                                " m a cell, expected a positive finite number");
  }
  if (!isFinite(origin)) throw std::invalid_argument("the grid's origin is not finite");
  CellField::operator=(CellField(columns, rows, fill));
}

CellIndex OccupancyGrid::cellAt(const Point2& point) const {
  const Point2 local = toLocalFrame(origin_, point);
  return {cellNumber(local.x / resolution_), cellNumber(local.y / resolution_)};
}

Point2 OccupancyGrid::centerOf(CellIndex index) const {
  return toParentFrame(origin_, {(index.column + 0.5) * resolution_, (index.row + 0.5) * resolution_});
}

}  // namespace lstm_planner
