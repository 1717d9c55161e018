// What a recorder notes beside the network's inputs: the path through what was seen.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lstm_planner/drive/decision/observer.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/local_map/memory_fixtures.hpp"

namespace lstm_planner::test_observer {
namespace {

using test::returnsAt;

const Point2 kGoal{4.0, 0.0};

/// Across the straight path; its right end is the nearer one.
const std::vector<Point2> kWall = test::wall({2.0, -1.0}, {2.0, 3.0});
const double kRoundTheWall = 2.0 * std::hypot(2.0, 1.0);  ///< m, at least, from the origin to the goal

std::vector<Point2> ringAroundTheGoal() {
  std::vector<Point2> points;
  for (const Point2& point : test::ring(0.45)) points.push_back({kGoal.x + point.x, kGoal.y + point.y});
  return points;
}

/// Odometry so bad that a goal may lie half a metre from where it is after a metre.
Observer withBadOdometry() {
  AgentParameters parameters;
  parameters.goal_drift = 0.5;
  return Observer(parameters);
}

TEST(Observer, TellsWhereThePathThroughWhatWasSeenStartsAndItsLength) {
  Observer observer{AgentParameters()};
  observer.start(kGoal);
  const Observation straight = observer.observe(returnsAt({}), kGoal, 0.0);
  EXPECT_NEAR(straight.route_bearing, 0.0, 1e-9);
  EXPECT_NEAR(straight.route_length, 4.0, 1e-9);
  const Observation round = observer.observe(returnsAt(kWall), kGoal, 0.0);
  EXPECT_LT(round.route_bearing, -std::atan2(1.0, 2.0)) << "past the wall's right end";
  EXPECT_GT(round.route_length, kRoundTheWall);
  EXPECT_NEAR(round.goal_distance, 4.0, 1e-9);
}

TEST(Observer, TellsTheStraightPathWhereNothingIsRemembered) {
  AgentParameters parameters;
  parameters.memory.enabled = false;
  Observer observer(parameters);
  observer.start(kGoal);
  EXPECT_NEAR(observer.observe(returnsAt(kWall), kGoal, 0.0).route_length, 4.0, 1e-9);
}

TEST(Observer, ANewGoalKeepsWhatWasSeenAndAJumpForgetsIt) {
  Observer observer{AgentParameters()};
  observer.start(kGoal);
  observer.observe(returnsAt(kWall), kGoal, 0.0);
  observer.start(kGoal);
  EXPECT_GT(observer.observe(returnsAt({}), kGoal, 0.0).route_length, kRoundTheWall);
  observer.forget();
  EXPECT_NEAR(observer.observe(returnsAt({}), kGoal, 0.0).route_length, 4.0, 1e-9);
}

TEST(Observer, AGoalThatMovesALittleDoesNotMakeThePathJumpToTheOtherSide) {
  const Situation wall = returnsAt(test::wall({2.0, -1.1}, {2.0, 1.0}));
  const Point2 moved{4.0, -0.2};
  Observer observer{AgentParameters()};
  observer.start(kGoal);
  ASSERT_GT(observer.observe(wall, kGoal, 0.0).route_bearing, 0.0) << "round the left end, which is the nearer one";
  EXPECT_GT(observer.observe(wall, moved, 0.0).route_bearing, 0.0);
  observer.start(moved);
  EXPECT_LT(observer.observe(wall, moved, 0.0).route_bearing, 0.0) << "who sets out for it anew";
}

TEST(Observer, TheTraceOfADriveEndsWithItsGoalOrAJump) {
  Observer observer{AgentParameters()};
  observer.start(kGoal);
  const auto behindBestAfter = [&](auto change) {
    observer.observe(returnsAt({}, {1.0, 0.0, 0.0}), kGoal, 0.0);
    change();
    return observer.observe(returnsAt({}), kGoal, 0.0).behind_best;
  };
  EXPECT_NEAR(behindBestAfter([] {}), 1.0, 1e-9);
  EXPECT_EQ(behindBestAfter([&] { observer.start(kGoal); }), 0.0);
  EXPECT_EQ(behindBestAfter([&] { observer.forget(); }), 0.0);
}

/// The goal lies in a ring, 0.45 m and a radius from where the robot can go: more than the tolerance at the start of a
/// drive, less after 1.35 m.
TEST(Observer, APathMayEndTheFartherFromTheGoalTheLongerTheDrive) {
  Observer observer = withBadOdometry();
  observer.start(kGoal);
  for (const double x : {0.65, 1.1, 1.55}) observer.observe(returnsAt({}, {x, 0.0, 0.0}), kGoal, 0.0);
  const Pose2 before_the_ring{2.0, 0.0, 0.0};
  const double beside = observer.observe(returnsAt(ringAroundTheGoal(), before_the_ring), kGoal, 0.0).route_length;
  EXPECT_LT(beside, 2.0 - 0.45 - ShieldParameters().footprint_radius + 0.05) << "but for what squares hide";
  observer.start(kGoal);
  EXPECT_EQ(observer.observe(returnsAt({}, before_the_ring), kGoal, 0.0).route_length, 2.0) << "there is none";
}

TEST(Observer, TheWayFromADriveToTheNextDoesNotCountAsDriven) {
  for (const bool jumps : {false, true}) {
    Observer observer = withBadOdometry();
    observer.start(kGoal);
    observer.observe(returnsAt({}, {0.65, 0.0, 0.0}), kGoal, 0.0);
    jumps ? observer.forget() : observer.start(kGoal);
    const Situation seen = returnsAt(ringAroundTheGoal(), {2.0, 0.0, 0.0});
    EXPECT_EQ(observer.observe(seen, kGoal, 0.0).route_length, 2.0) << jumps;
  }
}

}  // namespace
}  // namespace lstm_planner::test_observer
