#include "lstm_planner/grid/surface_points.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {

std::vector<Point2> surfacePoints(const OccupancyGrid& grid, double spacing) {
  if (!(spacing > 0.0)) {
    throw std::invalid_argument("the spacing is " + numberText(spacing) + " m, expected a positive number");
  }
  const double side = grid.resolution();
  const int pieces = static_cast<int>(std::ceil(side / spacing));
  std::vector<Point2> points;
  // From the corner (column, row), in cells, along a side.
  const auto addSide = [&](int column, int row, int right, int up) {
    for (int i = 0; i <= pieces; ++i) {
      const double along = static_cast<double>(i) / pieces;
      points.push_back(toParentFrame(grid.origin(), {(column + along * right) * side, (row + along * up) * side}));
    }
  };
  const auto isOccupied = [&](int column, int row) { return grid.at({column, row}) == Cell::kOccupied; };
  for (int row = 0; row <= grid.rows(); ++row) {
    for (int column = 0; column <= grid.columns(); ++column) {
      const bool here = isOccupied(column, row);
      if (here != isOccupied(column - 1, row)) addSide(column, row, 0, 1);
      if (here != isOccupied(column, row - 1)) addSide(column, row, 1, 0);
    }
  }
  return points;
}

}  // namespace lstm_planner
