#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid/distance_field.hpp"

namespace lstm_planner::test_distance_field {
namespace {

TEST(DistanceField, IsTheDistanceToTheNearestBlockedCentre) {
  constexpr double kResolution = 0.25;
  OccupancyGrid grid(40, 30, kResolution);
  Random random(3);
  std::vector<CellIndex> blocked;
  for (int i = 0; i < 12; ++i) {
    const CellIndex index{static_cast<int>(uniformIndex(random, 40)), static_cast<int>(uniformIndex(random, 30))};
    grid.set(index, i % 2 == 0 ? Cell::kOccupied : Cell::kUnknown);
    blocked.push_back(index);
  }
  const DistanceField field(grid, true);
  for (int row = 0; row < 30; ++row) {
    for (int column = 0; column < 40; ++column) {
      double nearest = HUGE_VAL;
      for (const CellIndex& index : blocked) {
        nearest = std::min(nearest, std::hypot(index.column - column, index.row - row));
      }
      ASSERT_NEAR(field.at({column, row}), nearest * kResolution, 1e-5) << column << " " << row;
    }
  }
}

TEST(DistanceField, TakesUnknownCellsForClearWhenTold) {
  OccupancyGrid grid(5, 1, 1.0);
  grid.set({1, 0}, Cell::kUnknown);
  grid.set({4, 0}, Cell::kOccupied);
  EXPECT_EQ(DistanceField(grid, false).at({0, 0}), 4.0f);
  EXPECT_EQ(DistanceField(grid, true).at({0, 0}), 1.0f);
}

TEST(DistanceField, IsLargeButFiniteWhereNothingIsBlocked) {
  const DistanceField field(OccupancyGrid(3, 3, 1.0), true);
  EXPECT_GT(field.at({1, 1}), 1e5f);
  EXPECT_TRUE(std::isfinite(field.at({1, 1})));
  EXPECT_EQ(field.at({3, 0}), 0.0f) << "outside";
}

GeodesicField geodesic(const OccupancyGrid& grid, CellIndex goal, const GeodesicField::Options& options) {
  return GeodesicField(grid, DistanceField(grid, true), goal, options);
}

TEST(GeodesicField, IsTheOctileDistanceInTheOpen) {
  const GeodesicField field = geodesic(OccupancyGrid(20, 20, 0.5), {2, 3}, {});
  EXPECT_NEAR(field.at({9, 6}), 0.5 * (4.0 + 3.0 * M_SQRT2), 1e-5);
  EXPECT_EQ(field.at({2, 3}), 0.0f);
  EXPECT_TRUE(std::isinf(field.at({20, 3}))) << "outside";
}

TEST(GeodesicField, CutsNoCorners) {
  OccupancyGrid grid(3, 3, 1.0);
  grid.set({1, 0}, Cell::kOccupied);
  const GeodesicField field = geodesic(grid, {0, 0}, {});
  EXPECT_NEAR(field.at({1, 1}), 2.0, 1e-6) << "up and right, not across the corner of the obstacle";
}

/// A wall in the middle with a door of three cells.
OccupancyGrid twoRooms() {
  OccupancyGrid grid(21, 15, 0.1);
  for (int row = 0; row < 15; ++row) {
    if (row < 6 || row > 8) grid.set({10, row}, Cell::kOccupied);
  }
  return grid;
}

TEST(GeodesicField, GoesThroughADoorOnlyWhereTheRobotFits) {
  EXPECT_NEAR(geodesic(twoRooms(), {5, 7}, {0.2, 0.0, 0.0}).at({15, 7}), 1.0, 1e-5);
  EXPECT_TRUE(std::isinf(geodesic(twoRooms(), {5, 7}, {0.25, 0.0, 0.0}).at({15, 7})));
}

TEST(GeodesicField, HasNoPathToAGoalInAWall) {
  EXPECT_TRUE(std::isinf(geodesic(twoRooms(), {10, 0}, {0.0, 0.0, 0.0}).at({5, 5})));
  EXPECT_TRUE(std::isinf(geodesic(twoRooms(), {-5, 700}, {}).at({5, 5})));
}

TEST(GeodesicField, PrefersTheMiddleWhenReluctant) {
  const GeodesicField field = geodesic(twoRooms(), {5, 7}, {0.1, 0.2, 2.0});
  EXPECT_NEAR(field.at({15, 7}), 1.0, 1e-5) << "the middle of the door is comfortable";
  // Column 9, row 4 lies right beside the wall, at the clearance: the step along it costs three times its length.
  EXPECT_NEAR(field.at({9, 4}) - field.at({8, 4}), 0.1 * (3.0 + 1.0) / 2.0, 1e-5);
}

}  // namespace
}  // namespace lstm_planner::test_distance_field
