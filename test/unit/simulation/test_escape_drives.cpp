#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/floor_plan.hpp"
#include "support/case_name.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_escape_drives {
namespace {

using End = DriveResult::End;

constexpr double kRadius = 0.17425;
const AgentParameters kDefaults;
const double kFollowDistance = kRadius + kDefaults.shield.clearance;  ///< m from the boundary to the robot's centre

/// Following is done in chords of the probing's directions and with a noisy scanner: longer than the boundary by this.
constexpr double kWobble = 1.25;

/// The network is of no help in these worlds: the escape need not wait for it long. Nor is it spared by a memory of
/// obstacles, which would find the way out first.
AgentParameters impatient() {
  AgentParameters parameters;
  parameters.memory.enabled = false;
  parameters.escape.patience_steps = 20;
  parameters.escape.patience_distance = 4.0;
  return parameters;
}

DriveResult driveStubbornly(const World& world, const Pose2& start, const Point2& goal, double time_limit,
                            const AgentParameters& parameters = impatient()) {
  NavigationAgent agent(test::straightAheadPolicy(), parameters);
  return drive(world, {start, goal, 0.0}, test::quickDrive(time_limit), 1, &agent);
}

/// That the drive ended like this, and without a contact.
void expectEnd(const DriveResult& result, End end) {
  EXPECT_EQ(static_cast<int>(result.end), static_cast<int>(end))
      << "after " << result.path_length << " m and " << result.time << " s";
  EXPECT_EQ(result.contacts, 0);
}

TEST(EscapeDrives, LeavesADeadEndBetweenStartAndGoal) {
  OccupancyGrid grid = test::emptyHall(12.0, 8.0);
  test::fillBox(7.0, 2.0, 7.1, 6.0, &grid);
  test::fillBox(4.0, 2.0, 7.1, 2.1, &grid);
  test::fillBox(4.0, 5.9, 7.1, 6.0, &grid);
  const DriveResult result = driveStubbornly(GridWorld(grid), {1.5, 4.0, 0.0}, {10.0, 4.0}, 900.0);
  expectEnd(result, End::kReached);
  EXPECT_GT(result.steps_by[indexOf(Leader::kEscape)], 0);
}

TEST(EscapeDrives, GoesRoundTheEndOfAThinWall) {
  OccupancyGrid grid = test::emptyHall(8.0, 6.0);
  test::fillBox(4.0, 0.0, 4.05, 4.5, &grid);
  // The goal is just behind the wall: a U-turn round its end.
  const DriveResult result = driveStubbornly(GridWorld(grid), {3.5, 1.0, 0.0}, {4.6, 1.0}, 600.0);
  expectEnd(result, End::kReached);
}

TEST(EscapeDrives, IsNotLuredBackByAGoalThatTheScannerCannotSee) {
  OccupancyGrid grid = test::emptyHall(8.0, 8.0);
  test::fillBox(4.0, 0.0, 4.1, 6.0, &grid);
  // On the way up the wall the goal is near, and behind the robot where the scanner is blind: it seems to be in sight.
  const DriveResult result = driveStubbornly(GridWorld(grid), {3.0, 3.0, 0.0}, {4.45, 3.0}, 900.0);
  expectEnd(result, End::kReached);
}

TEST(EscapeDrives, GetsOutOfASpiral) {
  const GridWorld world(test::spiral());
  // From the middle of the spiral to the lower left corner, where a straight line crosses three walls.
  const DriveResult result = driveStubbornly(world, {3.4, 3.0, 0.0}, {0.8, 0.8}, 1800.0);
  expectEnd(result, End::kReached);
}

/// A goal in a ring of posts, and the length of the path round it.
struct EnclosedGoal {
  EnclosedGoal(double radius, int posts) : round(2.0 * M_PI * (radius + kPost + kFollowDistance)) {
    for (int i = 0; i < posts; ++i) {
      circles.push_back({pointAlong(goal, 2.0 * M_PI * i / posts, radius), kPost});
    }
  }
  static constexpr double kPost = 0.1;
  Point2 goal{5.0, 0.0};
  std::vector<Circle> circles;
  double round;
};

/// To the goal, on with the network until its patience ends, and as far back.
double pathBeforeFollowing(double to_goal) {
  return to_goal + 2.0 * (impatient().escape.patience_distance + kDefaults.step.length);
}

TEST(EscapeDrives, KnowsThatAnEnclosedGoalCannotBeReached) {
  const EnclosedGoal enclosed(1.2, 120);
  const DriveResult result = driveStubbornly(CircleWorld(enclosed.circles), {0.0, 0.0, 0.0}, enclosed.goal, 900.0);
  expectEnd(result, End::kNoPath);
  // A ring shorter than the first leg of the doubling search is gone round without turning back; once more at the most,
  // as close to it as the robot can.
  ASSERT_LT(kWobble * enclosed.round, kDefaults.escape.first_leg);
  EXPECT_LT(result.path_length, pathBeforeFollowing(5.0) + 2.0 * kWobble * enclosed.round);
  EXPECT_GT(result.path_length, enclosed.round);  // it did look
}

TEST(EscapeDrives, KnowsItOfALargeRingToo) {
  const EnclosedGoal enclosed(3.6, 288);
  const DriveResult result = driveStubbornly(CircleWorld(enclosed.circles), {0.0, 0.0, 0.0}, enclosed.goal, 1800.0);
  expectEnd(result, End::kNoPath);
  // Here it turns back after the first leg, and goes round the other way.
  ASSERT_GT(enclosed.round, kDefaults.escape.first_leg);
  EXPECT_LT(result.path_length,
            pathBeforeFollowing(5.0) + 2.0 * kDefaults.escape.first_leg + 2.0 * kWobble * enclosed.round);
}

TEST(EscapeDrives, KnowsThatARoomWithoutDoorCannotBeLeft) {
  OccupancyGrid grid = test::emptyHall(9.0, 4.0);
  test::fillBox(3.0, 0.0, 3.1, 4.0, &grid);
  const DriveResult result = driveStubbornly(GridWorld(grid), {1.5, 2.0, 1.0}, {7.0, 2.0}, 3600.0);
  expectEnd(result, End::kNoPath);
  // Where the scanner sees nearer to the goal than it has been, the boundary is left, across the room at the most, and
  // met again; five times at the most. Each time it is followed for a first leg and back, and gone round twice.
  const double round = 2.0 * (2.9 + 3.8);
  const double across = std::hypot(2.9, 3.8);
  RecordProperty("path_length", std::to_string(result.path_length));
  EXPECT_LT(result.path_length,
            pathBeforeFollowing(3.0) + 5.0 * (across + 2.0 * kDefaults.escape.first_leg + 2.0 * kWobble * round));
}

TEST(EscapeDrives, TurnsBackWhenTheWallIsLongOnOneSide) {
  // The wall ends 5 m to the right, and 60 m to the left. It slants so that the turn to the left is the smaller one.
  OccupancyGrid grid(1400, 320, 0.05, {-61.0, -5.0, 0.0});
  for (double along = -60.0; along <= 5.0; along += 0.02) {
    const double x = along;
    const double y = 2.0 - 0.05 * along;
    const CellIndex cell = grid.cellAt({x, y});
    for (int row = cell.row - 1; row <= cell.row + 1; ++row) {
      grid.set({cell.column, row}, Cell::kOccupied);
    }
  }
  AgentParameters parameters;
  parameters.memory.enabled = false;
  parameters.escape.patience_steps = 3;  // the network is of no help here
  parameters.escape.first_leg = 1.0;
  const DriveResult result = driveStubbornly(GridWorld(grid), {0.0, 0.0, M_PI_2}, {0.0, 5.0}, 1800.0, parameters);
  expectEnd(result, End::kReached);
  // The wall is met about 1.64 m up, 3.36 m before the goal. Past its right end the path to the goal is open; at the
  // latest it is left where the robot is nearer to the goal than 3.36 m, 1.9 m beside it. The doubling search finds
  // this place within nine times the path there (legs of 1, 2, 4, ... m to and fro until one is longer than it).
  const double path = 5.1 + M_PI * (kFollowDistance + 0.1) + (5.1 - 1.9);
  const double beside = 1.64 + std::hypot(5.5, 3.0) + 4 * parameters.step.length;  // to it, from it, patience
  EXPECT_LT(result.path_length, 9.0 * path * kWobble + beside);
  // It did go the wrong way first, and did not go to its end.
  double leftmost = 0.0;
  for (const Pose2& pose : result.trace) leftmost = std::min(leftmost, pose.x);
  EXPECT_LT(leftmost, -1.0);
  EXPECT_GT(leftmost, -2.0 * path * kWobble);
}

class UselessPolicyDrives : public ::testing::TestWithParam<int> {};

TEST_P(UselessPolicyDrives, ReachEveryGoalOfAFloorPlan) {
  FloorPlanParameters plan;
  plan.width = 12.0;
  plan.height = 9.0;
  const GridWorld world(generateFloorPlan(plan, static_cast<std::uint64_t>(GetParam())));
  const std::vector<DriveTask> tasks = drawTasks(world, 20, kRadius, 0.12, 2.0, static_cast<std::uint64_t>(GetParam()));
  NavigationAgent agent(noPolicy(), {});
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const DriveTask& task = tasks[i];
    const DriveResult result = drive(world, task, test::quickDrive(1800.0), i, &agent);
    SCOPED_TRACE("task " + std::to_string(i) + " from " + std::to_string(task.start.x) + " " +
                 std::to_string(task.start.y) + " " + std::to_string(task.start.yaw) + " to " +
                 std::to_string(task.goal.x) + " " + std::to_string(task.goal.y));
    expectEnd(result, End::kReached);
  }
}

INSTANTIATE_TEST_SUITE_P(FloorPlans, UselessPolicyDrives, ::testing::Values(1, 2), test::caseName("Seed"));

}  // namespace
}  // namespace lstm_planner::test_escape_drives
