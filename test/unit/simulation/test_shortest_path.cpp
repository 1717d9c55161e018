#include <gtest/gtest.h>

#include <cmath>

#include "simulation/shortest_path.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_shortest_path {
namespace {

constexpr double kClearance = 0.25;

struct Paths {
  double any_angle = 0.0;
  double along_the_grid = 0.0;
};

Paths between(const OccupancyGrid& grid, const Point2& start, const Point2& goal) {
  const DistanceField distances(grid, true);
  const CellIndex from = grid.cellAt(start);
  const CellIndex to = grid.cellAt(goal);
  const GeodesicField field(grid, distances, to, {kClearance, 0.0, 0.0});
  return {shortestPath(distances, field, grid, from, to, kClearance), field.at(from)};
}

TEST(ShortestPath, IsStraightInTheOpen) {
  const OccupancyGrid hall = test::emptyHall(8.0, 6.0);
  for (const Point2& goal : {Point2{7.0, 3.0}, Point2{5.0, 5.0}, Point2{1.5, 5.2}}) {
    const Point2 from = hall.centerOf(hall.cellAt({1.0, 1.0}));
    const Point2 to = hall.centerOf(hall.cellAt(goal));
    EXPECT_NEAR(between(hall, {1.0, 1.0}, goal).any_angle, distanceBetween(from, to), 1e-4);
  }
}

TEST(ShortestPath, BendsAtTheCornersOfWhatIsInBetween) {
  OccupancyGrid grid = test::emptyHall(8.0, 6.0);
  test::fillBox(3.9, 0.0, 4.1, 4.0, &grid);
  const Paths paths = between(grid, {1.025, 1.025}, {7.025, 1.025});
  // Round two corners, each a clearance away. The path bends in the middle of a cell near them.
  const double beside = std::hypot(4.0 - 0.125 - 1.025, 4.0 + kClearance - 1.025);
  const double above = 2.0 * kClearance * std::asin(1.0);  // a quarter circle at each corner at the most
  EXPECT_GT(paths.any_angle, 2.0 * std::hypot(4.0 - 0.1 - kClearance - 1.025, 4.0 - 1.025));
  EXPECT_LT(paths.any_angle, 2.0 * beside + above + 0.25);
  EXPECT_LT(paths.any_angle, paths.along_the_grid);
}

TEST(ShortestPath, IsNeverLongerThanAlongTheGridNorShorterThanStraight) {
  OccupancyGrid grid = test::emptyHall(10.0, 8.0);
  for (int i = 0; i < 12; ++i) {
    const double x = 1.5 + 2.2 * (i % 4);
    const double y = 1.2 + 2.3 * (i / 4) + 0.4 * (i % 2);
    test::fillBox(x, y, x + 0.7, y + 0.9, &grid);
  }
  for (int i = 0; i < 10; ++i) {
    const Point2 start{0.6, 0.6 + 0.68 * i};
    const Point2 goal{9.4, 7.4 - 0.68 * i};
    const Paths paths = between(grid, start, goal);
    ASSERT_TRUE(std::isfinite(paths.any_angle));
    EXPECT_LE(paths.any_angle, paths.along_the_grid + 1e-4);
    EXPECT_GE(paths.any_angle, distanceBetween(start, goal) - 0.1);
  }
}

TEST(ShortestPath, IsInfiniteWhereThereIsNone) {
  OccupancyGrid grid = test::emptyHall(8.0, 6.0);
  test::fillBox(3.9, 0.0, 4.1, 6.0, &grid);
  EXPECT_TRUE(std::isinf(between(grid, {1.0, 1.0}, {7.0, 1.0}).any_angle));
}

}  // namespace
}  // namespace lstm_planner::test_shortest_path
