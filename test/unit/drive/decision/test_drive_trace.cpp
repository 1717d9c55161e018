#include <gtest/gtest.h>

#include "lstm_planner/drive/decision/drive_trace.hpp"

namespace lstm_planner::test_drive_trace {
namespace {

Observation seen(double free, double goal_distance) {
  Observation observation;
  observation.sector_ranges.fill(free);
  observation.goal_distance = goal_distance;
  return observation;
}

TEST(DriveTrace, LooksAroundCounterClockwiseFromTheHeading) {
  for (const double yaw : {0.0, M_PI_2}) {
    DriveTrace trace;
    Observation observation = seen(6.0, 5.0);
    trace.update({0.25, 1.05, 0.0}, &observation);  // 0.8 m to the north of where it is then
    observation = seen(6.0, 5.0);
    trace.update({0.25, 0.25, yaw}, &observation);
    for (std::size_t i = 0; i < observation.visits.size(); ++i) {
      const bool north = i == (yaw == 0.0 ? 2u : 0u);
      EXPECT_EQ(observation.visits[i], north ? 1.0 : 0.0) << i;
      EXPECT_EQ(observation.places[PlaceTrace::kStep].visits[i], north ? 1.0 : 0.0) << i;
      if (north) {
        EXPECT_EQ(observation.places[PlaceTrace::kStep].ages[i], 1.0);
      }
    }
  }
}

TEST(DriveTrace, ProbesPlacesOnThisSideOfWhatIsSeen) {
  DriveTrace trace;
  Observation observation = seen(6.0, 5.0);
  trace.update({2.25, 0.75, 0.0}, &observation);
  observation = seen(6.0, 5.0);
  trace.update({0.25, 0.75, 0.0}, &observation);
  EXPECT_EQ(observation.places[PlaceTrace::kRoom].visits[0], 1.0) << "2 m ahead";
  observation = seen(1.0, 5.0);  // a wall 1 m ahead: what is behind it is no matter
  trace.update({0.25, 0.75, 0.0}, &observation);
  EXPECT_EQ(observation.places[PlaceTrace::kRoom].visits[0], 1.0) << "the square that it is in";
  EXPECT_EQ(observation.places[PlaceTrace::kRoom].ages[0], 0.0);
  EXPECT_EQ(observation.room_visits, 1.0);
}

TEST(DriveTrace, KnowsItsProgress) {
  DriveTrace trace;
  const auto at = [&](double distance) {
    Observation observation = seen(6.0, distance);
    trace.update({}, &observation);
    return observation;
  };
  EXPECT_EQ(at(5.0).steps_since_best, 0.0);
  EXPECT_EQ(at(4.5).behind_best, 0.0);
  EXPECT_EQ(at(4.45).steps_since_best, 1.0) << "less than kProgress is none";
  const Observation away = at(6.5);
  EXPECT_EQ(away.steps_since_best, 2.0);
  EXPECT_NEAR(away.behind_best, 2.0, 1e-12);
  EXPECT_EQ(at(4.0).steps_since_best, 0.0);
}

TEST(DriveTrace, TellsTheMotionSinceTheStepBefore) {
  DriveTrace trace;
  Observation observation = seen(6.0, 5.0);
  trace.update({1.0, 1.0, M_PI_2}, &observation);
  EXPECT_EQ(observation.motion.x, 0.0);
  EXPECT_EQ(observation.turn, 0.0);
  trace.update({0.9, 1.4, M_PI}, &observation);
  EXPECT_NEAR(observation.motion.x, 0.4, 1e-12);
  EXPECT_NEAR(observation.motion.y, 0.1, 1e-12);
  EXPECT_NEAR(observation.turn, M_PI_2, 1e-12);
}

TEST(DriveTrace, ForgetsEverythingWithANewGoal) {
  DriveTrace trace;
  Observation observation = seen(6.0, 5.0);
  trace.update({0.25, 0.25, 0.0}, &observation);
  trace.clear();
  observation = seen(6.0, 7.0);
  trace.update({0.75, 0.25, 0.0}, &observation);
  EXPECT_EQ(observation.behind_best, 0.0);
  EXPECT_EQ(observation.motion.x, 0.0);
  for (const double visits : observation.visits) EXPECT_EQ(visits, 0.0);
}

}  // namespace
}  // namespace lstm_planner::test_drive_trace
