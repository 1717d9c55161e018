#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lstm_planner/grid/surface_points.hpp"
#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/generated_world.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_route_drives {
namespace {

using End = DriveResult::End;

const AgentParameters kDefaults;
const double kRadius = kDefaults.shield.footprint_radius;

/// A drive along the path through what is remembered.
DriveResult driveGuided(const World& world, const DriveTask& task, const DriveParameters& parameters,
                        std::uint64_t seed = 1) {
  NavigationAgent agent(noPolicy(), test::routeLed());
  return drive(world, task, parameters, seed, &agent);
}

void expectReached(const DriveResult& result, double longest) {
  EXPECT_EQ(static_cast<int>(result.end), static_cast<int>(End::kReached))
      << "after " << result.path_length << " m and " << result.time << " s, " << result.goal_error
      << " m from the goal";
  EXPECT_EQ(result.contacts, 0);
  EXPECT_LT(result.path_length, longest);
}

TEST(RouteDrives, ARoomWithoutDoorIsKnownToBeClosedAfterAFewMetres) {
  OccupancyGrid grid = test::emptyHall(9.0, 4.0);
  test::fillBox(3.0, 0.0, 3.1, 4.0, &grid);
  const DriveResult result = driveGuided(GridWorld(grid), {{1.5, 2.0, 1.0}, {7.0, 2.0}, 0.0}, test::quickDrive(300.0));
  EXPECT_EQ(static_cast<int>(result.end), static_cast<int>(End::kNoPath));
  EXPECT_EQ(result.contacts, 0);
  // Across the room to the wall that hides the goal, and to what it had not seen behind it: no perimeter (13.4 m).
  EXPECT_LT(result.path_length, 2.0 * std::hypot(2.9, 3.8));
  // Three turns on the spot at half of what the Create 2 can do, and that way at a quarter.
  EXPECT_LT(result.time, 120.0);
}

TEST(RouteDrives, AnEnclosedGoalIsKnownToBeEnclosed) {
  OccupancyGrid grid = test::emptyHall(10.0, 8.0);
  test::fillBox(5.0, 2.5, 7.5, 5.5, &grid);
  for (int row = 52; row < 108; ++row) {
    for (int column = 102; column < 148; ++column) grid.set({column, row}, Cell::kFree);
  }
  AgentParameters trusting = test::routeLed();
  trusting.goal_drift = 0.0;  // or the wall before the goal would be held for one beside it
  NavigationAgent agent(noPolicy(), trusting);
  const DriveResult result =
      drive(GridWorld(grid), {{1.0, 4.0, 0.0}, {6.2, 4.0}, 0.0}, test::quickDrive(900.0), 1, &agent);
  EXPECT_EQ(static_cast<int>(result.end), static_cast<int>(End::kNoPath));
  EXPECT_EQ(result.contacts, 0);
  // No place shows all of its walls: each time round that found no path is forgotten, four times, before the boundary
  // is followed, which takes a first leg there and back, and the path round again.
  const double round = 2.0 * (2.5 + 3.0) + 2.0 * M_PI * (kRadius + 0.12);
  RecordProperty("path_length", std::to_string(result.path_length));
  EXPECT_LT(result.path_length, 4.0 + 5.0 * 1.25 * round + 2.0 * kDefaults.escape.first_leg + 1.25 * round);
}

TEST(RouteDrives, ARobotWithOneWheelThatIsTooSmallArrives) {
  OccupancyGrid grid = test::emptyHall(12.0, 8.0);
  test::fillBox(4.0, 0.0, 4.5, 5.0, &grid);
  test::fillBox(7.5, 3.0, 8.0, 8.0, &grid);
  const DriveTask task{{1.5, 2.0, 0.0}, {10.0, 6.0}, 0.0};
  DriveParameters parameters = test::quickDrive(200.0);
  parameters.robot.base.drift = 0.01;  // turns it by 0.02 / 0.235 m = 5 degrees a metre, which odometry does not notice
  const DriveResult corrected = driveGuided(GridWorld(grid), task, parameters);
  expectReached(corrected, 20.0);
  EXPECT_LT(corrected.goal_error, parameters.motion.position_tolerance + 0.05);

  AgentParameters by_odometry = test::routeLed();
  by_odometry.correct_drift = false;
  NavigationAgent agent(noPolicy(), by_odometry);
  const DriveResult alone = drive(GridWorld(grid), task, parameters, 1, &agent);
  EXPECT_GT(alone.goal_error, 1.0) << "odometry alone does not do";
}

TEST(RouteDrives, LeavesADeadEndByTheShortestPath) {
  OccupancyGrid grid = test::emptyHall(12.0, 8.0);
  test::fillBox(7.0, 2.0, 7.1, 6.0, &grid);
  test::fillBox(4.0, 2.0, 7.1, 2.1, &grid);
  test::fillBox(4.0, 5.9, 7.1, 6.0, &grid);
  const DriveResult result = driveGuided(GridWorld(grid), {{1.5, 4.0, 0.0}, {10.0, 4.0}, 0.0}, test::quickDrive(200.0));
  // In to its end and out again on the way round its mouth: 5.3 m and 3 m, and 4.3 + 2.2 + 3 + 3.6 m outside.
  expectReached(result, 1.25 * (5.3 + 3.0 + 4.3 + 2.2 + 3.0 + 3.6));
}

TEST(RouteDrives, ARobotThatKnowsTheMapLooksIntoNoDeadEnd) {
  // A room between start and goal with one door, towards the start, through which its corners are not seen.
  OccupancyGrid grid = test::emptyHall(12.0, 8.0);
  test::fillBox(4.0, 2.0, 4.1, 3.5, &grid);
  test::fillBox(4.0, 4.5, 4.1, 6.0, &grid);
  test::fillBox(7.0, 2.0, 7.1, 6.0, &grid);
  test::fillBox(4.0, 2.0, 7.1, 2.1, &grid);
  test::fillBox(4.0, 5.9, 7.1, 6.0, &grid);
  const GridWorld world(grid);
  const DriveTask task{{1.5, 4.0, 0.0}, {10.0, 4.0}, 0.0};
  const auto looksIn = [](const DriveResult& drive) {
    return std::any_of(drive.trace.begin(), drive.trace.end(), [](const Pose2& pose) {
      return distanceBetween(pose, Point2{4.05, 4.0}) < 1.0;
    });
  };

  const DriveResult route = driveGuided(world, task, test::quickDrive(200.0));
  EXPECT_TRUE(looksIn(route));

  NavigationAgent agent(noPolicy(), test::routeLed());
  std::vector<Point2> obstacles = surfacePoints(grid, 0.5 * kDefaults.memory.resolution);
  for (Point2& place : obstacles) place = toLocalFrame(task.start, place);
  agent.know(obstacles);
  const DriveResult known = drive(world, task, test::quickDrive(200.0), 1, &agent);
  EXPECT_FALSE(looksIn(known));
  // Round two corners of the room, as far away from them as there is room for.
  const double beside = 2.0 - kRadius - kDefaults.memory.comfort;
  const double around = std::hypot(2.5, 4.0 - beside) + 3.1 + std::hypot(2.9, 4.0 - beside);
  expectReached(known, 1.05 * around);
  // To the door and back again.
  EXPECT_GT(route.path_length, known.path_length + 1.0);
}

TEST(RouteDrives, GetsOutOfASpiralWithoutTurningBack) {
  const GridWorld world(test::spiral());
  const DriveResult result = driveGuided(world, {{3.4, 3.0, 0.0}, {0.8, 0.8}, 0.0}, test::quickDrive(400.0));
  // Along the middle of the corridors: 0.4, 1.2 and 1.6, 3.4, 3.6, 4.8 ... m; the path is one only.
  const double path = 0.8 + 1.6 + 2.2 + 3.2 + 3.6 + 4.8 + 5.6 + 5.2;
  expectReached(result, 1.25 * path);
}

TEST(RouteDrives, ComesAsNearToAGoalBesideAWallAsTheFootprintFits) {
  const GridWorld world(test::emptyHall(6.0, 6.0));
  DriveParameters lenient = test::quickDrive(120.0);
  lenient.goal_radius = 0.4;  // how near it comes is told below
  for (const double gap : {0.12, 0.19, 0.25}) {
    for (const double shift : {0.03, 0.13}) {
      SCOPED_TRACE(gap);
      const DriveResult result = driveGuided(world, {{1.5 + shift, 2.0, 2.0}, {5.9 - gap, 3.03}, 0.0}, lenient);
      expectReached(result, 1.25 * std::hypot(4.4, 1.03) + 1.0);
      // Where it fits with the tight clearance, to a square of the memory, and the tolerance with which it stops.
      const double needed = kRadius + kDefaults.shield.tight_clearance + kDefaults.memory.resolution;
      EXPECT_LT(result.goal_error, std::max(0.0, needed - gap) + MotionParameters{}.position_tolerance);
    }
  }
}

struct Course {
  WorldKind kind;
  std::uint64_t seed;
  double odometry_error;
  double latency;
};

class GeneratedWorldDrives : public ::testing::TestWithParam<Course> {};

TEST_P(GeneratedWorldDrives, ReachEveryGoalWithoutContact) {
  const Course& course = GetParam();
  const GridWorld world(generateWorld(course.kind, worldSeed(WorldUse::kValidation, course.seed, 0)));
  DriveParameters parameters = test::quickDrive(400.0);
  parameters.robot.base.odometry_error = course.odometry_error;
  parameters.robot.latency = course.latency;
  const std::vector<DriveTask> tasks = drawTasks(world, 3, kRadius, 0.12, 4.0, course.seed);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    SCOPED_TRACE("task " + std::to_string(i));
    // Nobody knows the path beforehand: dead ends are looked into.
    expectReached(driveGuided(world, tasks[i], parameters, i), 6.0 * tasks[i].shortest + 6.0);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Courses, GeneratedWorldDrives,
    ::testing::Values(Course{WorldKind::kMaze, 1, 0.0, 0.0}, Course{WorldKind::kMaze, 2, 0.02, 0.0},
                      Course{WorldKind::kOffice, 3, 0.02, 0.0}, Course{WorldKind::kOffice, 4, 0.0, 0.1},
                      Course{WorldKind::kForest, 5, 0.02, 0.1}, Course{WorldKind::kCorridors, 6, 0.02, 0.0}),
    [](const ::testing::TestParamInfo<Course>& info) {
      return std::string(toString(info.param.kind)) + std::to_string(info.param.seed);
    });

TEST(RouteDrives, CrossesAnOpenFieldStraight) {
  const GridWorld world(generateWorld(WorldKind::kOpen, 1));
  DriveParameters parameters = test::quickDrive(200.0);
  parameters.robot.base.odometry_error = 0.02;
  const DriveResult result = driveGuided(world, {{3.0, 3.0, 2.0}, {12.0, 8.0}, 0.0}, parameters);
  expectReached(result, 1.1 * std::hypot(9.0, 5.0));
}

}  // namespace
}  // namespace lstm_planner::test_route_drives
