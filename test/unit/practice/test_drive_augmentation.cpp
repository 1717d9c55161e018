#include <gtest/gtest.h>

#include <stdexcept>

#include "practice/drive_augmentation.hpp"
#include "unit/simulation/recorded_drives_fixtures.hpp"

namespace lstm_planner::test_drive_augmentation {
namespace {

const std::vector<double> kAngles = RecorderParameters().action_angles;

/// An observation as the recorder would make it of what the step holds besides.
Observation observedAnew(const DriveStep& step) {
  Sectors sectors;
  sectors.range = step.observation.sector_ranges;
  return observe(sectors, step.pose, step.goal, step.observation.previous_action);
}

void expectConsistent(const RecordedEpisode& episode) {
  for (const DriveStep& step : episode.steps) {
    const Observation observation = observedAnew(step);
    EXPECT_NEAR(step.observation.goal_bearing, observation.goal_bearing, 1e-9);
    EXPECT_NEAR(step.observation.goal_distance, observation.goal_distance, 1e-9);
    EXPECT_NEAR(normalizeAngle(step.observation.heading - observation.heading), 0.0, 1e-9);
    const double driven = normalizeAngle(directionTo(step.pose, step.next_pose) - step.pose.yaw);
    EXPECT_NEAR(step.driven_angle, driven, 1e-9);
    EXPECT_EQ(step.label, ActionSet().nearest(driven));
  }
}

TEST(DriveAugmentation, AMirroredDriveIsOneThatCouldHaveBeenRecorded) {
  const RecordedEpisode episode = driveTowards({3.0, 4.0}, 30, {0.5, -0.2, 2.0});
  expectConsistent(episode);
  const RecordedEpisode other = mirrored(episode, kAngles);
  expectConsistent(other);
  EXPECT_EQ(other.steps[0].observation.goal_bearing, -episode.steps[0].observation.goal_bearing);
  EXPECT_EQ(other.steps[0].label, 4 - episode.steps[0].label);
  EXPECT_NE(other.steps[0].label, episode.steps[0].label);
}

TEST(DriveAugmentation, MirroringTwiceChangesNothing) {
  RecordedEpisode episode = driveTowards({-3.0, 1.0}, 3);
  DriveStep& step = episode.steps[1];
  step.geometry = {"laser", -1.0, 0.01, 150, 0.1, 30.0, {{0.1, 0.05, 0.2}, false}};
  step.ranges = {1.0f, 2.0f, 3.0f};
  step.geometry.beams = 3;
  for (std::size_t i = 0; i < kPlaceDirections; ++i) step.observation.visits[i] = static_cast<double>(i);
  const DriveStep twice = mirrored(mirrored(episode, kAngles), kAngles).steps[1];
  EXPECT_EQ(twice.observation.visits, step.observation.visits);
  EXPECT_EQ(twice.observation.goal_bearing, step.observation.goal_bearing);
  EXPECT_EQ(twice.ranges, step.ranges);
  EXPECT_EQ(twice.pose.y, step.pose.y);
  EXPECT_NEAR(twice.geometry.angle_min, step.geometry.angle_min, 1e-12);
  EXPECT_EQ(twice.geometry.mount.pose.yaw, step.geometry.mount.pose.yaw);
}

TEST(DriveAugmentation, WhatWasOnTheLeftIsOnTheRight) {
  RecordedEpisode episode = driveTowards({3.0, 0.0}, 1);
  DriveStep& step = episode.steps[0];
  step.observation.sector_ranges = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 6.0, 6.0};
  step.observation.visits = {9.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};  // ahead, then to the left
  step.observation.route_bearing = 0.5;
  step.geometry = {"laser", -1.0, 0.5, 3, 0.1, 30.0, {}};  // -1 .. 0 rad: to the right
  step.ranges = {1.0f, 2.0f, 3.0f};
  const DriveStep other = mirrored(episode, kAngles).steps[0];
  EXPECT_EQ(other.observation.sector_ranges, (std::array<double, 8>{6.0, 6.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0}));
  EXPECT_EQ(other.observation.visits, (std::array<double, 8>{9.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0}));
  EXPECT_EQ(other.observation.route_bearing, -0.5);
  EXPECT_NEAR(other.geometry.angle_min, 0.0, 1e-12);  // 0 .. 1 rad: to the left
  EXPECT_EQ(other.ranges, (std::vector<float>{3.0f, 2.0f, 1.0f}));
}

TEST(DriveAugmentation, ATurnedDriveDiffersInItsHeadingOnly) {
  const RecordedEpisode episode = driveTowards({3.0, 4.0}, 20);
  const RecordedEpisode other = turned(episode, 2.5);
  expectConsistent(other);
  for (std::size_t i = 0; i < episode.steps.size(); ++i) {
    EXPECT_NEAR(other.steps[i].observation.goal_bearing, episode.steps[i].observation.goal_bearing, 1e-12);
    EXPECT_NEAR(normalizeAngle(other.steps[i].observation.heading - episode.steps[i].observation.heading - 2.5), 0.0,
                1e-12);
  }
}

TEST(DriveAugmentation, VariantsAreMirroredInTurnAndTheSameForTheSameSeed) {
  Dataset dataset = drivesAllAround(3, 5, 1);
  dataset.recordings[0].episodes[1].episode.discarded = true;
  const Dataset variants = variantsOf(dataset, 3, 7);
  ASSERT_EQ(variants.recordings[0].episodes.size(), 6u);
  const auto bearing = [](const Dataset& from, std::size_t episode) {
    return from.recordings[0].episodes[episode].steps[0].observation.goal_bearing;
  };
  EXPECT_NEAR(bearing(variants, 0), -bearing(dataset, 0), 1e-12);
  EXPECT_NEAR(bearing(variants, 1), bearing(dataset, 0), 1e-12);
  EXPECT_NEAR(bearing(variants, 2), -bearing(dataset, 0), 1e-12);
  EXPECT_NEAR(bearing(variants, 3), -bearing(dataset, 2), 1e-12);
  const auto heading = [](const Dataset& from) { return from.recordings[0].episodes[0].steps[0].pose.yaw; };
  EXPECT_EQ(heading(variantsOf(dataset, 3, 7)), heading(variants));
  EXPECT_NE(heading(variantsOf(dataset, 3, 8)), heading(variants));
}

TEST(DriveAugmentation, AnglesOfOneSideCannotBeMirrored) {
  EXPECT_THROW(mirrored(driveTowards({1.0, 0.0}, 2), {-1.0, 0.0, 0.5}), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_drive_augmentation
