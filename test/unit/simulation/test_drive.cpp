#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lstm_planner/simulation/crowd.hpp"
#include "lstm_planner/simulation/drive.hpp"
#include "support/refusal.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_drive {
namespace {

DriveResult resultOf(DriveResult::End end, double path_length, double shortest, double time = 10.0) {
  DriveResult result;
  result.end = end;
  result.path_length = path_length;
  result.shortest = shortest;
  result.time = time;
  return result;
}

TEST(Summarize, CountsEnds) {
  std::vector<DriveResult> results = {
      resultOf(DriveResult::End::kReached, 1.0, 1.0, 10.0), resultOf(DriveResult::End::kReached, 3.0, 1.0, 20.0),
      resultOf(DriveResult::End::kTimeout, 90.0, 1.0, 1800.0), resultOf(DriveResult::End::kNoPath, 50.0, 1.0, 500.0),
      resultOf(DriveResult::End::kElsewhere, 2.0, 1.0)};
  results[1].contacts = 2;
  results[1].goal_error = 0.2;
  results[3].bumped = 3;
  results[2].contacts = 1;
  const DriveSummary summary = summarize(results);
  EXPECT_EQ(summary.goals, 5);
  EXPECT_EQ(summary.reached, 2);
  EXPECT_EQ(summary.timeouts, 1);
  EXPECT_EQ(summary.no_path, 1);
  EXPECT_EQ(summary.elsewhere, 1);
  EXPECT_EQ(summary.contacts, 3);
  EXPECT_EQ(summary.bumped, 3);
  EXPECT_DOUBLE_EQ(summary.mean_goal_error, 0.1);
  EXPECT_DOUBLE_EQ(summary.mean_ratio, 2.0);  // only of those that arrived
  EXPECT_DOUBLE_EQ(summary.mean_time, 15.0);
}

TEST(Summarize, TakesThePercentileByRank) {
  std::vector<DriveResult> results;
  for (int i = 20; i >= 1; --i) results.push_back(resultOf(DriveResult::End::kReached, i, 1.0));
  EXPECT_DOUBLE_EQ(summarize(results).p95_ratio, 19.0);  // rank 0.95 * 20
  results.push_back(resultOf(DriveResult::End::kReached, 100.0, 1.0));
  EXPECT_DOUBLE_EQ(summarize(results).p95_ratio, 20.0);  // rank ceil(0.95 * 21) = 20
  EXPECT_DOUBLE_EQ(summarize({results[0]}).p95_ratio, 20.0);
}

TEST(Summarize, LeavesOutUnknownShortestPathsAndSurvivesNothing) {
  EXPECT_EQ(summarize({}).goals, 0);
  EXPECT_EQ(summarize({}).p95_ratio, 0.0);
  const DriveSummary summary = summarize({resultOf(DriveResult::End::kReached, 7.0, 0.0, 3.0)});
  EXPECT_EQ(summary.mean_ratio, 0.0);
  EXPECT_DOUBLE_EQ(summary.mean_time, 3.0);
}

/// Two halls, joined by nothing: the left one is 4 m wide, the right one 2 m.
OccupancyGrid twoHalls() {
  OccupancyGrid grid = test::emptyHall(6.2, 4.0);
  test::fillBox(4.0, 0.0, 4.2, 4.0, &grid);
  return grid;
}

TEST(DrawTasks, DrawsTheSameForTheSameSeed) {
  const GridWorld world(twoHalls());
  const std::vector<DriveTask> tasks = drawTasks(world, 10, 0.17425, 0.1, 1.0, 3);
  const std::vector<DriveTask> again = drawTasks(world, 10, 0.17425, 0.1, 1.0, 3);
  const std::vector<DriveTask> others = drawTasks(world, 10, 0.17425, 0.1, 1.0, 4);
  ASSERT_EQ(tasks.size(), 10u);
  bool all_equal = true;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    EXPECT_EQ(tasks[i].start.x, again[i].start.x);
    EXPECT_EQ(tasks[i].start.yaw, again[i].start.yaw);
    EXPECT_EQ(tasks[i].goal.y, again[i].goal.y);
    all_equal = all_equal && tasks[i].start.x == others[i].start.x;
  }
  EXPECT_FALSE(all_equal);
}

TEST(DrawTasks, EveryTaskCanBeDriven) {
  const GridWorld world(twoHalls());
  for (const DriveTask& task : drawTasks(world, 30, 0.17425, 0.1, 1.0, 5)) {
    EXPECT_FALSE(world.touches({task.start.x, task.start.y}, 0.27425));
    EXPECT_FALSE(world.touches(task.goal, 0.27425));
    EXPECT_EQ(task.start.x < 4.0, task.goal.x < 4.0);  // never from hall to hall
    EXPECT_GE(task.shortest, 1.0);
    EXPECT_GE(task.shortest, distanceBetween(task.start, task.goal) - 1e-4);
    EXPECT_LE(task.shortest, distanceBetween(task.start, task.goal) + 1e-4) << "nothing is in between";
  }
}

TEST(DrawTasks, RefusesAMapWithoutTasks) {
  const GridWorld full(OccupancyGrid(40, 40, 0.05, {}, Cell::kOccupied));
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] {
              drawTasks(full, 1, 0.17425, 0.1, 1.0, 1);
            }).rfind("there is no place for a disc ", 0),
            0u);
  const GridWorld small(test::emptyHall(2.0, 2.0));
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] {
              drawTasks(small, 1, 0.17425, 0.1, 5.0, 1);
            }).rfind("there are no two places at least 5 m apart ", 0),
            0u);
}

TEST(Drive, ReachesAGoalInAnEmptyHall) {
  const GridWorld world(test::emptyHall(6.0, 4.0));
  NavigationAgent agent(test::straightAheadPolicy(), {});
  const DriveResult result = drive(world, {{1.0, 2.0, 0.0}, {5.0, 2.0}, 4.0}, {}, 1, &agent);
  EXPECT_EQ(result.end, DriveResult::End::kReached);
  EXPECT_EQ(result.contacts, 0);
  const auto by = [&](Decision::Choice source) { return result.steps_by[indexOf(source)]; };
  EXPECT_GT(by(Leader::kNetwork), 5);
  EXPECT_GT(by(Decision::Move::kGoalInSight), 1) << "the last metre and a half";
  EXPECT_EQ(by(Leader::kNetwork) + by(Decision::Move::kGoalInSight), result.steps);
  EXPECT_EQ(shareOf(Leader::kRoute, {result}), 0.0);
  EXPECT_DOUBLE_EQ(shareOf(Leader::kNetwork, {result}) + shareOf(Decision::Move::kGoalInSight, {result}), 1.0);
  EXPECT_NEAR(result.path_length, 3.8, 0.05);  // 4 m less the controller's tolerance of 0.2 m
  EXPECT_EQ(result.trace.size(), result.led.size());
  EXPECT_EQ(result.shortest, 4.0);
}

TEST(Drive, IsTheSameForTheSameSeed) {
  const GridWorld world(test::emptyHall(6.0, 4.0));
  const DriveTask task{{1.0, 1.0, 2.0}, {5.0, 3.0}, 0.0};
  const auto run = [&](std::uint64_t seed) {
    NavigationAgent agent(noPolicy(), {});
    return drive(world, task, test::quickDrive(120.0), seed, &agent);
  };
  const DriveResult first = run(1);
  const DriveResult again = run(1);
  ASSERT_EQ(first.trace.size(), again.trace.size());
  for (std::size_t i = 0; i < first.trace.size(); ++i) {
    ASSERT_EQ(first.trace[i].x, again.trace[i].x);
    ASSERT_EQ(first.trace[i].yaw, again.trace[i].yaw);
  }
  EXPECT_EQ(first.path_length, again.path_length);
  EXPECT_EQ(first.steps, again.steps);
}

TEST(Drive, OwesNothingToTheDriveBefore) {
  const GridWorld world(test::emptyHall(6.0, 4.0));
  const DriveTask task{{1.0, 1.0, 2.0}, {5.0, 3.0}, 0.0};
  NavigationAgent agent(test::straightAheadPolicy(), {});
  const double first = drive(world, task, test::quickDrive(120.0), 1, &agent).path_length;
  drive(world, {{4.0, 2.0, 0.0}, {1.0, 2.0}, 0.0}, test::quickDrive(120.0), 2, &agent);
  EXPECT_EQ(drive(world, task, test::quickDrive(120.0), 1, &agent).path_length, first);
}

TEST(Drive, EndsAtTheTimeLimit) {
  const GridWorld world(test::emptyHall(6.0, 4.0));
  NavigationAgent agent(test::straightAheadPolicy(), {});
  const DriveResult result = drive(world, {{1.0, 2.0, 0.0}, {5.0, 2.0}, 4.0}, test::quickDrive(3.0), 1, &agent);
  EXPECT_EQ(result.end, DriveResult::End::kTimeout);
  EXPECT_NEAR(result.time, 3.0, 0.1 + 1e-9);
}

TEST(Drive, ARobotWhoseSecondScannerMeasuresNothingStands) {
  const CircleWorld world({{{-0.3, 0.0}, 0.05}});  // nearer to the scanner than it can measure
  DriveParameters parameters = test::quickDrive(3.0);
  parameters.robot.second_scanner = parameters.robot.scanner;
  parameters.robot.second_scanner->mount.pose = {-0.17, 0.0, M_PI};
  parameters.robot.second_scanner->range_min = 0.2;
  NavigationAgent agent(test::straightAheadPolicy(), {});
  const DriveResult result = drive(world, {{}, {5.0, 0.0}, 5.0}, parameters, 1, &agent);
  EXPECT_EQ(result.end, DriveResult::End::kTimeout);
  EXPECT_EQ(result.path_length, 0.0);
  parameters.robot.second_scanner->range_min = 0.02;
  EXPECT_GT(drive(world, {{}, {5.0, 0.0}, 5.0}, parameters, 1, &agent).path_length, 0.3);
}

/// The robot drives 8 m straight on; its odometry errs as it does for that seed.
DriveResult driveWithDrift(double odometry_error, Arrival arrival, std::uint64_t seed) {
  NavigationAgent agent(test::straightAheadPolicy(), {});
  DriveParameters parameters = test::quickDrive(120.0);
  parameters.robot.base.odometry_error = odometry_error;
  parameters.arrival = arrival;
  return drive(CircleWorld({}), {{}, {8.0, 0.0}, 8.0}, parameters, seed, &agent);
}

TEST(Drive, BelievesTheRobotAsFarAsItsOdometryCanKnow) {
  // 30 % of 8 m: nearly every robot ends more than the goal's radius away, where the referee does not see it arrive.
  int elsewhere = 0;
  double error = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    EXPECT_EQ(driveWithDrift(0.3, Arrival::kRobotSays, seed).end, DriveResult::End::kReached);
    const DriveResult judged = driveWithDrift(0.3, Arrival::kTruePosition, seed);
    elsewhere += judged.end == DriveResult::End::kElsewhere ? 1 : 0;
    error = std::max(error, judged.goal_error);
  }
  EXPECT_GE(elsewhere, 5);
  EXPECT_GT(error, 0.3);
}

TEST(Drive, DoesNotBelieveARobotWhoseWheelsSpin) {
  // It sees nothing at all and drives against a pillar, where its odometry counts on.
  const CircleWorld pillar({{{3.0, 0.0}, 0.3}});
  NavigationAgent agent(test::straightAheadPolicy(), {});
  DriveParameters blind = test::quickDrive(120.0);
  blind.robot.scanner.dropout = 1.0;
  const DriveResult result = drive(pillar, {{}, {8.0, 0.0}, 8.0}, blind, 1, &agent);
  EXPECT_EQ(result.end, DriveResult::End::kElsewhere);
  EXPECT_EQ(result.contacts, 1);
  ASSERT_EQ(result.contact_places.size(), 1u);
  EXPECT_NEAR(result.contact_places[0].x, 3.0 - 0.3 - 0.17425, 0.01);
}

TEST(Drive, EndsAtTheFirstTouchWhereTheRulesSaySo) {
  const CircleWorld pillar({{{3.0, 0.0}, 0.3}});
  NavigationAgent agent(test::straightAheadPolicy(), {});
  DriveParameters blind = test::quickDrive(120.0);
  blind.robot.scanner.dropout = 1.0;
  blind.ends_at_touch = true;
  const DriveResult result = drive(pillar, {{}, {8.0, 0.0}, 8.0}, blind, 1, &agent);
  EXPECT_EQ(result.end, DriveResult::End::kTouched);
  EXPECT_EQ(result.contacts, 1);
  EXPECT_LT(result.path_length, 3.0);
  EXPECT_EQ(summarize({result}).touched, 1);
}

TEST(Drive, EndsWhereTheControllerGivesUp) {
  // A blind alley as wide as the robot, which looks at its end and never was elsewhere: it can neither turn nor go
  // back.
  OccupancyGrid alley = test::emptyHall(6.0, 4.0);
  test::fillBox(4.0, 1.6, 6.0, 1.75, &alley);
  test::fillBox(4.0, 2.25, 6.0, 2.4, &alley);
  test::fillBox(5.0, 1.6, 6.0, 2.4, &alley);
  DriveParameters parameters = test::quickDrive(600.0);
  parameters.robot.base.footprint = "[[0.3, 0.2], [0.3, -0.2], [-0.3, -0.2], [-0.3, 0.2]]";
  AgentParameters agent_parameters;
  agent_parameters.shield.footprint = parameters.robot.base.footprint;
  agent_parameters.shield.footprint_radius = 0.2;
  NavigationAgent agent(test::straightAheadPolicy(), agent_parameters);
  const DriveResult result = drive(GridWorld(alley), {{4.6, 2.0, 0.0}, {1.0, 2.0}, 3.6}, parameters, 1, &agent);
  EXPECT_EQ(result.end, DriveResult::End::kStuck);
  EXPECT_EQ(result.contacts, 0);
  EXPECT_LT(result.time, 6.0 * parameters.motion.patience);
  EXPECT_EQ(summarize({result}).stuck, 1);
}

TEST(Drive, KeepsThePathsOfThePeopleAround) {
  const GridWorld world(test::emptyHall(6.0, 4.0));
  const std::vector<Point2> places = standingPlaces(world, 0.3);
  CrowdParameters two;
  two.walkers = 2;
  Crowd crowd(world, places, two, {1.0, 2.0}, 3);
  NavigationAgent agent(test::straightAheadPolicy(), {});
  const DriveResult result = drive(&crowd, {{1.0, 2.0, 0.0}, {5.0, 2.0}, 4.0}, test::quickDrive(5.0), 1, &agent);
  ASSERT_EQ(result.walker_traces.size(), 2u);
  EXPECT_EQ(result.walker_traces[0].size(), result.trace.size());
  EXPECT_GT(distanceBetween(result.walker_traces[0].front(), result.walker_traces[0].back()), 0.0);
}

TEST(Drive, RefusesARolloutThatWouldNotEnd) {
  const GridWorld world(test::emptyHall(6.0, 4.0));
  NavigationAgent agent(test::straightAheadPolicy(), {});
  const auto run = [&](const DriveParameters& parameters) {
    drive(world, {{1.0, 2.0, 0.0}, {5.0, 2.0}, 4.0}, parameters, 1, &agent);
  };
  DriveParameters parameters;
  parameters.rollout.spacing = 0.0;
  EXPECT_THROW(run(parameters), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_drive
