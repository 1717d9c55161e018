#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/practice/teacher.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_teacher {
namespace {

/// A hall of 8 x 4 m with a wall across the middle and a door of 1 m in it, at y = 2.5 .. 3.5.
OccupancyGrid hallWithDoor() {
  OccupancyGrid grid = test::emptyHall(8.0, 4.0);
  test::fillBox(3.95, 0.0, 4.05, 2.5, &grid);
  test::fillBox(3.95, 3.5, 4.05, 4.0, &grid);
  return grid;
}

TEST(Teacher, PointsStraightAlongACorridor) {
  const GridWorld world(test::emptyHall(8.0, 1.4));
  const Teacher teacher(world, {7.0, 0.7});
  double direction = 0.0;
  ASSERT_TRUE(teacher.direction({1.0, 0.7}, &direction));
  // Cells are 5 cm: at the end of 0.5 m the path may lie one cell aside.
  EXPECT_NEAR(direction, 0.0, 0.1);
  const Teacher back(world, {1.0, 0.7});
  ASSERT_TRUE(back.direction({7.0, 0.7}, &direction));
  EXPECT_NEAR(std::abs(direction), M_PI, 0.1);
}

TEST(Teacher, LeadsToTheDoorNotToTheGoal) {
  const GridWorld world(hallWithDoor());
  const Teacher teacher(world, {6.0, 1.0});
  double direction = 0.0;
  ASSERT_TRUE(teacher.direction({3.3, 1.0}, &direction));
  EXPECT_GT(direction, degreesToRadians(45.0));  // up along the wall, the goal is straight ahead
  ASSERT_TRUE(teacher.direction({4.0, 3.0}, &direction));
  EXPECT_NEAR(direction, 0.0, degreesToRadians(35.0));  // through the door
  ASSERT_TRUE(teacher.direction({4.7, 2.7}, &direction));
  EXPECT_LT(direction, degreesToRadians(-30.0));  // down again
}

TEST(Teacher, FollowingItArrives) {
  const GridWorld world(hallWithDoor());
  const Point2 goal{6.0, 1.0};
  const Teacher teacher(world, goal);
  Point2 at{2.0, 1.0};
  double driven = 0.0;
  while (distanceBetween(at, goal) > 0.2 && driven < 20.0) {
    double direction = 0.0;
    ASSERT_TRUE(teacher.direction(at, &direction));
    at = pointAlong(at, direction, 0.1);
    driven += 0.1;
    ASSERT_FALSE(world.touches(at, 0.17425)) << at.x << " " << at.y;
  }
  // Shortest for a disc that keeps 0.1 m: 2 m and 2 m to and from the lower door post, and a part of a circle.
  const double leg = std::hypot(1.95, 2.5 + 0.27 - 1.0);
  EXPECT_LT(driven, 1.15 * (2.0 * leg + 0.1));
}

TEST(Teacher, DistanceToGoFallsByThePathDriven) {
  const GridWorld world(test::emptyHall(8.0, 4.0));
  const Teacher teacher(world, {7.025, 2.025});  // far from all walls, where the path costs its length
  EXPECT_NEAR(teacher.distanceToGo({7.025, 2.025}), 0.0, 1e-6);
  EXPECT_NEAR(teacher.distanceToGo({3.025, 2.025}), 4.0, 1e-4);
  EXPECT_NEAR(teacher.distanceToGo({5.025, 2.025}), 2.0, 1e-4);
}

TEST(Teacher, KnowsThePathFromAPlaceTooNearToAWall) {
  const GridWorld world(test::emptyHall(8.0, 4.0));
  const Teacher teacher(world, {7.0, 2.0});
  double direction = 0.0;
  ASSERT_TRUE(teacher.direction({1.0, 0.3}, &direction));  // 0.2 m to the wall, where 0.27 are kept
  EXPECT_GT(direction, 0.0);                               // away from it
  EXPECT_LT(direction, M_PI_2);
  EXPECT_TRUE(std::isfinite(teacher.distanceToGo({1.0, 0.3})));
}

TEST(Teacher, HasNoAnswerWhereThereIsNoPath) {
  OccupancyGrid grid = test::emptyHall(8.0, 4.0);
  test::fillBox(3.95, 0.0, 4.05, 4.0, &grid);
  const GridWorld world(grid);
  double direction = 0.0;
  EXPECT_FALSE(Teacher(world, {6.0, 2.0}).direction({2.0, 2.0}, &direction));
  EXPECT_TRUE(std::isinf(Teacher(world, {6.0, 2.0}).distanceToGo({2.0, 2.0})));
  EXPECT_FALSE(Teacher(world, {4.0, 2.0}).direction({2.0, 2.0}, &direction));  // the goal is in the wall
  EXPECT_FALSE(Teacher(world, {99.0, 2.0}).direction({2.0, 2.0}, &direction));
  EXPECT_FALSE(Teacher(world, {2.0, 2.0}).direction({-50.0, 2.0}, &direction));
}

TEST(Teacher, IsContentAtTheGoal) {
  const GridWorld world(test::emptyHall(8.0, 4.0));
  double direction = 99.0;
  EXPECT_TRUE(Teacher(world, {2.0, 2.0}).direction({2.0, 2.0}, &direction));
  EXPECT_TRUE(std::isfinite(direction));
}

}  // namespace
}  // namespace lstm_planner::test_teacher
