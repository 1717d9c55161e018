#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner::test_occupancy_grid {
namespace {

TEST(OccupancyGrid, FindsCellsThroughATurnedOrigin) {
  // Turned by 90 degrees about (1, 2): columns run along the map's y, rows along its -x.
  const OccupancyGrid grid(10, 20, 0.5, {1.0, 2.0, M_PI_2});
  const CellIndex index = grid.cellAt({1.0 - 0.6, 2.0 + 1.2});
  EXPECT_EQ(index.column, 2);
  EXPECT_EQ(index.row, 1);
  const Point2 center = grid.centerOf({2, 1});
  EXPECT_NEAR(center.x, 1.0 - 0.75, 1e-12);
  EXPECT_NEAR(center.y, 2.0 + 1.25, 1e-12);
}

TEST(OccupancyGrid, IsUnknownOutside) {
  OccupancyGrid grid(2, 2, 1.0);
  EXPECT_EQ(grid.at({0, 0}), Cell::kFree);
  EXPECT_EQ(grid.at({2, 0}), Cell::kUnknown);
  EXPECT_EQ(grid.at({0, -1}), Cell::kUnknown);
  EXPECT_EQ(grid.at(grid.cellAt({1e300, 0.5})), Cell::kUnknown) << "a cell number beyond an int";
  EXPECT_EQ(grid.at(grid.cellAt({std::numeric_limits<double>::quiet_NaN(), 0.5})), Cell::kUnknown);
}

TEST(OccupancyGrid, RefusesImpossibleGeometry) {
  EXPECT_THROW(OccupancyGrid(0, 1, 1.0), std::invalid_argument);
  EXPECT_THROW(OccupancyGrid(1, 1, 0.0), std::invalid_argument);
  EXPECT_THROW(OccupancyGrid(1, 1, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW(OccupancyGrid(1, 1, 1.0, {HUGE_VAL, 0.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(OccupancyGrid(1 << 15, 1 << 14, 1.0), std::invalid_argument) << "2^29 cells";
}

}  // namespace
}  // namespace lstm_planner::test_occupancy_grid
