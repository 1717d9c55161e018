#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "lstm_planner/grid/surface_points.hpp"

namespace lstm_planner::test_surface_points {
namespace {

TEST(SurfacePoints, LieOnAllOuterSidesOfABlockAndNotInsideIt) {
  // Turned by 90 degrees about (1, 2): columns run along the map's y, rows along its -x. The block is of 2 x 1 cells.
  OccupancyGrid grid(4, 4, 0.5, {1.0, 2.0, M_PI_2});
  grid.set({1, 1}, Cell::kOccupied);
  grid.set({2, 1}, Cell::kOccupied);
  const std::vector<Point2> points = surfacePoints(grid, 0.2);
  EXPECT_EQ(points.size(), 6u * 4u) << "sides of a cell, which 0.2 m divide into three pieces";
  for (const Point2& point : points) {
    const Point2 local = toLocalFrame(grid.origin(), point);
    const double inside = std::min({local.x - 0.5, 1.5 - local.x, local.y - 0.5, 1.0 - local.y});
    EXPECT_NEAR(inside, 0.0, 1e-12) << local.x << ", " << local.y;
  }
}

TEST(SurfacePoints, AreThoseOfTheMapsBorderToo) {
  const OccupancyGrid full(1, 1, 0.5, {}, Cell::kOccupied);
  EXPECT_EQ(surfacePoints(full, 0.5).size(), 4u * 2u);
  EXPECT_TRUE(surfacePoints(OccupancyGrid(3, 3, 0.5), 0.5).empty());
}

TEST(SurfacePoints, RefuseASpacingThatIsNotPositive) {
  for (const double spacing : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(surfacePoints(OccupancyGrid(1, 1, 0.5), spacing), std::invalid_argument);
  }
}

}  // namespace
}  // namespace lstm_planner::test_surface_points
