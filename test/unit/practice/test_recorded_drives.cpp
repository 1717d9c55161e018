#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/practice/recorded_drives.hpp"
#include "unit/dataset/step_list.hpp"

namespace lstm_planner::test_recorded_drives {
namespace {

const GridWorld& building() {
  static const GridWorld world(readMapServerMap(LSTM_PLANNER_SOURCE_DIR "/config/demo_building.yaml"));
  return world;
}

/// Few beams: what is recorded is the same.
RecordedDrivesParameters quickParameters() {
  RecordedDrivesParameters parameters;
  parameters.robot.scanner.beams = 136;
  parameters.robot.scanner.angle_increment *= 8.0;
  parameters.robot.base.odometry_error = 0.02;
  return parameters;
}

RecordedDrives record(const RecordedDrivesParameters& parameters, std::uint64_t seed, StepList* sink) {
  return recordDrives(building(), drawWaypoints(building(), 20, 0.35, 1.5, 1), parameters, seed, sink);
}

TEST(Waypoints, LieApartWhereARobotHasRoom) {
  const std::vector<Point2> points = drawWaypoints(building(), 20, 0.35, 1.5, 1);
  ASSERT_EQ(points.size(), 20u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_FALSE(building().touches(points[i], 0.35));
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE(distanceBetween(points[i], points[j]), 1.5);
  }
  const std::vector<Point2> others = drawWaypoints(building(), 20, 0.35, 1.5, 2);
  EXPECT_NE(points.front().x, others.front().x);
}

TEST(Waypoints, AreAllInTheLargestPartOfAMap) {
  OccupancyGrid grid(100, 20, 0.1);
  for (int row = 0; row < 20; ++row) grid.set({30, row}, Cell::kOccupied);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (const Point2& point : drawWaypoints(GridWorld(grid), 5, 0.3, 0.5, seed)) EXPECT_GT(point.x, 3.1);
  }
}

TEST(Waypoints, LieNearerToEachOtherWhereThereIsNoRoomForMore) {
  const OccupancyGrid grid(10, 10, 0.1);
  EXPECT_EQ(drawWaypoints(GridWorld(grid), 10, 0.2, 5.0, 1).size(), 10u);
}

TEST(Waypoints, AreRefusedWhereThereAreNone) {
  const OccupancyGrid solid(10, 10, 0.1, {}, Cell::kOccupied);
  try {
    drawWaypoints(GridWorld(solid), 2, 0.2, 1.0, 1);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("has 0 connected places for a disc of radius 0.2"), std::string::npos)
        << error.what();
  }
}

TEST(RecordedDrives, GiveAsManyStepsAsWantedWithoutAnyContact) {
  RecordedDrivesParameters parameters = quickParameters();
  parameters.steps = 300;
  StepList sink;
  const RecordedDrives drives = record(parameters, 1, &sink);
  EXPECT_EQ(drives.steps, 300);
  EXPECT_EQ(drives.contacts, 0);
  EXPECT_EQ(drives.no_path, 0);
  EXPECT_EQ(drives.reached + 1, drives.goals) << "all but the one on the way to which the steps were complete";
  long steps = 0;
  for (const RecordedEpisode& episode : sink.episodes()) steps += static_cast<long>(episode.steps.size());
  EXPECT_EQ(steps, 300);
  // It drives 0.3 m/s; odometry may take that for 2 % more.
  for (const RecordedEpisode& episode : sink.episodes()) {
    for (const DriveStep& step : episode.steps) {
      const double seconds = step.next_stamp - step.stamp;
      EXPECT_LT(distanceBetween(step.pose, step.next_pose), 0.3 * seconds + 0.01);
    }
  }
}

TEST(RecordedDrives, EndAtTheirGoalsThoughOdometryErrs) {
  RecordedDrivesParameters parameters = quickParameters();
  parameters.steps = 0;
  parameters.goals = 6;
  StepList sink;
  const RecordedDrives drives = record(parameters, 2, &sink);
  EXPECT_EQ(drives.goals, 6);
  EXPECT_EQ(drives.reached, 6);
  ASSERT_EQ(sink.episodes().size(), 6u);
  for (const RecordedEpisode& episode : sink.episodes()) {
    EXPECT_EQ(episode.episode.end, EpisodeEnd::kArrived);
    EXPECT_EQ(episode.episode.goal_source, "waypoints");
    EXPECT_EQ(episode.episode.goal.frame, "map");
  }
  // Only what happens between an arrival and the next goal is not about any goal.
  EXPECT_LT(sink.rejections()[static_cast<std::size_t>(Rejection::kNoGoal)], 6 * 10);
  EXPECT_EQ(sink.rejections()[static_cast<std::size_t>(Rejection::kNoOdometry)], 0);
  EXPECT_EQ(sink.rejections()[static_cast<std::size_t>(Rejection::kLate)], 0);
}

TEST(RecordedDrives, TurnOftenEnoughToLearnTurning) {
  RecordedDrivesParameters parameters = quickParameters();
  parameters.steps = 600;
  StepList sink;
  record(parameters, 3, &sink);
  std::array<int, 5> labels{};
  for (const RecordedEpisode& episode : sink.episodes()) {
    for (const DriveStep& step : episode.steps) ++labels.at(static_cast<std::size_t>(step.label));
  }
  // A building is mostly straight on; a network that always says so must be wrong one time in ten.
  EXPECT_GT(labels[2], 600 / 2);
  EXPECT_LT(labels[2], 600 * 9 / 10);
  EXPECT_GT(labels[1], 600 / 50);
  EXPECT_GT(labels[3], 600 / 50);
  EXPECT_GT(labels[0], 0);
  EXPECT_GT(labels[4], 0);
}

TEST(RecordedDrives, AreTheSameForTheSameSeedOnly) {
  RecordedDrivesParameters parameters = quickParameters();
  parameters.steps = 60;
  const auto anglesOf = [&](std::uint64_t seed) {
    StepList sink;
    record(parameters, seed, &sink);
    std::vector<double> angles;
    for (const RecordedEpisode& episode : sink.episodes()) {
      for (const DriveStep& step : episode.steps) {
        angles.push_back(step.driven_angle);
        angles.push_back(step.observation.sector_ranges[0]);
      }
    }
    return angles;
  };
  EXPECT_EQ(anglesOf(1), anglesOf(1));
  EXPECT_NE(anglesOf(1), anglesOf(2));
}

TEST(RecordedDrives, TurnToTheNextGoalWhereThereIsNoPath) {
  RecordedDrivesParameters parameters = quickParameters();
  parameters.steps = 0;
  parameters.goals = 8;
  std::vector<Point2> waypoints = drawWaypoints(building(), 3, 0.35, 1.5, 1);
  waypoints.push_back({0.0, 0.0});  // in the wall
  StepList sink;
  const RecordedDrives drives = recordDrives(building(), waypoints, parameters, 1, &sink);
  EXPECT_GT(drives.no_path, 0);
  EXPECT_EQ(drives.reached + drives.no_path, 8);
}

TEST(RecordedDrives, RefuseWaypointsThatLeadNowhere) {
  StepList sink;
  EXPECT_THROW(recordDrives(building(), {{2.0, 2.0}}, quickParameters(), 1, &sink), std::invalid_argument);
  // It starts at the first, and all others are in walls.
  EXPECT_THROW(recordDrives(building(), {drawWaypoints(building(), 1, 0.35, 1.5, 1)[0], {0.0, 0.0}, {0.0, 1.0}},
                            quickParameters(), 1, &sink),
               std::invalid_argument);
}

TEST(RecordedDrives, NeedAnEnd) {
  RecordedDrivesParameters parameters = quickParameters();
  parameters.steps = 0;
  StepList sink;
  EXPECT_THROW(record(parameters, 1, &sink), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_recorded_drives
