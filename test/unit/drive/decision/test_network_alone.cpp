#include <gtest/gtest.h>

#include <set>
#include <string>

#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "support/agent_steps.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_network_alone {
namespace {

using GoalSeems = Decision::GoalSeems;
using Move = Decision::Move;
using test::situationAt;

constexpr int kStraight = 2;

/// A network that leads without rescue and without a memory of obstacles.
class NetworkAloneTest : public ::testing::Test {
 protected:
  NetworkAloneTest() {
    parameters_.escape.enabled = false;
    parameters_.memory.enabled = false;
  }

  NavigationAgent agentTo(const Point2& goal) const {
    NavigationAgent agent(test::policyPreferring({0.0f, 0.5f, 1.0f, 0.5f, 0.0f}), parameters_);
    agent.setGoal(goal);
    return agent;
  }

  /// Makes so many steps forth and back, where the robot sees these obstacles; returns the actions.
  std::set<int> stepToAndFro(const Pose2& place, int steps, const std::vector<Point2>& obstacles,
                             NavigationAgent* agent) {
    std::set<int> actions;
    for (int i = 0; i < steps; ++i) {
      const Pose2 pose{place.x, place.y + (i % 2 == 0 ? 0.05 : -0.05), place.yaw};
      actions.insert(test::decideIn(situationAt(pose, time_ += 1.0, obstacles), agent).action);
    }
    return actions;
  }

  /// Drives 9.6 m straight to a place before the goal, in the open.
  void driveUpTo(const Pose2& place, NavigationAgent* agent) {
    for (int i = 24; i > 0; --i)
      test::decideIn(situationAt({place.x - 0.4 * i, place.y, place.yaw}, time_ += 1.0), agent);
  }

  AgentParameters parameters_;
  double time_ = 0.0;
};

TEST_F(NetworkAloneTest, DrawsItsStepsOnceItHasMadeNoProgressForLong) {
  NavigationAgent agent = agentTo({10.0, 0.0});
  EXPECT_EQ(stepToAndFro({}, parameters_.draw_after, {}, &agent), std::set<int>{kStraight});
  EXPECT_EQ(stepToAndFro({}, 100, {}, &agent), (std::set<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(agent.decision().overruled, Overruled::kNo) << "what was drawn is the network's answer";
}

TEST_F(NetworkAloneTest, DrawsNothingIfItIsNotAllowed) {
  parameters_.draw_after = 0;
  NavigationAgent agent = agentTo({10.0, 0.0});
  EXPECT_EQ(stepToAndFro({}, 200, {}, &agent), std::set<int>{kStraight});
}

TEST_F(NetworkAloneTest, DrawsOnceAStepHoweverOftenItIsAsked) {
  NavigationAgent agent = agentTo({10.0, 0.0});
  stepToAndFro({}, parameters_.draw_after, {}, &agent);
  for (int step = 0; step < 20; ++step) {
    stepToAndFro({0.1 * (step % 2), 0.0, 0.0}, 1, {}, &agent);
    const Decision first = agent.decision();
    const Decision& again = test::decideIn(situationAt({0.1 * (step % 2), 0.05, 0.0}, time_ + 0.1), &agent);
    EXPECT_EQ(again.step, first.step);
    EXPECT_EQ(again.action, first.action);
  }
}

/// The goal is 0.4 m ahead, behind a wall 0.25 m ahead; the robot has driven 9.6 m, and its odometry may be wrong by 3
/// %.
class GoalBehindAWallTest : public NetworkAloneTest {
 protected:
  GoalBehindAWallTest() : wall_(test::wall({0.25, -2.0}, {0.25, 2.0})) {}

  /// What is decided after the last of so many steps without progress.
  Decision after(int steps, const std::vector<Point2>& obstacles) {
    NavigationAgent agent = agentTo(kGoal);
    driveUpTo(kPlace, &agent);
    stepToAndFro(kPlace, 1 + steps, obstacles, &agent);
    return agent.decision();
  }

  static constexpr Point2 kGoal{10.0, 0.0};
  static constexpr Pose2 kPlace{9.6, 0.0, 0.0};
  const std::vector<Point2> wall_;
};

TEST_F(GoalBehindAWallTest, CountsAsReachedAfterEightTimesThePatience) {
  const int steps = 8 * parameters_.escape.patience_steps;
  EXPECT_NE(after(steps - 1, wall_).choice, Move::kArrived);
  const Decision decision = after(steps, wall_);
  EXPECT_EQ(decision.choice, Move::kArrived);
  EXPECT_EQ(decision.goal_seems, GoalSeems::kBehindObstacle);
  EXPECT_NEAR(distanceBetween(decision.destination, Point2{kPlace.x, kPlace.y}), 0.05, 1e-9)
      << "where the robot stands";
}

TEST_F(GoalBehindAWallTest, IsDrivenToIfThereIsNoWall) {
  EXPECT_EQ(after(parameters_.escape.patience_steps, {}).choice, Move::kGoalInSight);
}

TEST_F(GoalBehindAWallTest, IsNotReachedIfOdometryIsRight) {
  parameters_.goal_drift = 0.0;
  EXPECT_NE(after(10 * parameters_.escape.patience_steps, wall_).choice, Move::kArrived);
}

TEST_F(GoalBehindAWallTest, IsSearchedForByFollowingBoundaries) {
  parameters_.escape.enabled = true;
  const Decision decision = after(parameters_.escape.patience_steps, wall_);
  EXPECT_NE(decision.choice, Move::kArrived);
  EXPECT_EQ(decision.leader, Leader::kEscape);
}

}  // namespace
}  // namespace lstm_planner::test_network_alone
