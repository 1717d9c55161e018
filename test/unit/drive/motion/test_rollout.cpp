#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lstm_planner/drive/motion/rollout.hpp"
#include "lstm_planner/drive/perception/reach.hpp"
#include "support/agent_steps.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_rollout {
namespace {

using test::situationAt;

class Rollout : public ::testing::Test {
 protected:
  Rollout() : agent_(test::straightAheadPolicy(), forgetful()) {}

  /// Without remembered obstacles the plan behind the waypoint is what is tested here.
  static AgentParameters forgetful() {
    AgentParameters parameters;
    parameters.memory.enabled = false;
    return parameters;
  }

  const std::vector<Pose2>& planFor(const Situation& situation, const Pose2& goal) {
    agent_.setGoal({goal.x, goal.y});
    test::decideIn(situation, &agent_);
    rollOut(situation, agent_.decision(), agent_.shield(), goal, agent_.parameters(), parameters_, &plan_);
    return plan_;
  }

  double longestGap() const {
    double longest = 0.0;
    for (std::size_t i = 1; i < plan_.size(); ++i) {
      longest = std::max(longest, distanceBetween(plan_[i - 1], plan_[i]));
    }
    return longest;
  }

  NavigationAgent agent_;
  RolloutParameters parameters_;
  std::vector<Pose2> plan_;
};

TEST_F(Rollout, BeginsAtThePoseAndEndsAtTheGoalWithItsYaw) {
  const Pose2 pose{1.0, 2.0, 0.5};
  const Pose2 goal{7.0, -3.0, 2.5};
  const std::vector<Pose2>& plan = planFor(situationAt(pose), goal);
  EXPECT_EQ(plan.front().x, pose.x);
  EXPECT_EQ(plan.front().y, pose.y);
  EXPECT_EQ(plan.front().yaw, pose.yaw);
  EXPECT_EQ(plan.back().x, goal.x);
  EXPECT_EQ(plan.back().y, goal.y);
  EXPECT_EQ(plan.back().yaw, goal.yaw);
}

TEST_F(Rollout, IsDenseAndLooksAlongItself) {
  const std::vector<Pose2>& plan = planFor(situationAt({1.0, 2.0, 0.5}), {7.0, -3.0, 2.5});
  EXPECT_LE(longestGap(), parameters_.spacing + 1e-9);
  for (std::size_t i = 1; i + 1 < plan.size(); ++i) {
    EXPECT_NEAR(normalizeAngle(plan[i].yaw - directionTo(plan[i - 1], plan[i])), 0.0, 1e-6) << i;
  }
}

TEST_F(Rollout, GoesThroughTheWaypointFirst) {
  const std::vector<Pose2>& plan = planFor(situationAt({0.0, 0.0, M_PI_2}), {5.0, 0.0, 0.0});
  ASSERT_GT(plan.size(), 9u);  // the waypoint is 0.4 m ahead: eight poses
  for (int i = 1; i <= 8; ++i) {
    EXPECT_NEAR(plan[static_cast<std::size_t>(i)].x, 0.0, 1e-12);
    EXPECT_NEAR(plan[static_cast<std::size_t>(i)].y, 0.05 * i, 1e-12);
  }
}

TEST_F(Rollout, OfTwoStepsAsFarAsideOfTheGoalTakesTheOneThatIsFree) {
  // Behind the network's steps, at (0.8, 0), the path ahead and the one to the right are blocked.
  planFor(situationAt({}, 0.0, {{1.3, 0.0}, {1.15, -0.4}}), {4.0, 0.0, 0.0});
  const auto left =
      std::max_element(plan_.begin(), plan_.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
  EXPECT_NEAR(left->y, 0.4 * std::sin(M_PI / 4.0), 1e-6);
}

TEST_F(Rollout, GoesRoundWhatTheScanShows) {
  // A wall across the path, with its end 0.4 m to the left of it. The path through it is not the path of the plan.
  const std::vector<Point2> wall = test::wall({1.2, -1.5}, {1.2, 0.4});
  const std::vector<Pose2>& plan = planFor(situationAt({}, 0.0, wall), {2.2, 0.3, 0.0});
  // Up to where it leaves straight for the goal it keeps the footprint's distance from the wall.
  const double needed = agent_.parameters().shield.footprint_radius;
  const double tail = plan[plan.size() - 2].yaw;
  std::size_t end = plan.size() - 1;
  while (end > 0 && std::abs(normalizeAngle(plan[end - 1].yaw - tail)) < 1e-9) --end;
  ASSERT_GT(end, 8u);
  for (std::size_t i = 0; i < end; ++i) {
    for (const Point2& point : wall) {
      ASSERT_GT(distanceBetween(plan[i], point), needed) << "pose " << i;
    }
  }
}

TEST_F(Rollout, StaysWhereTheGoalIs) {
  const std::vector<Pose2>& plan = planFor(situationAt({1.0, 1.0, 0.3}), {1.0, 1.0, 2.0});
  ASSERT_EQ(plan.size(), 2u);
  EXPECT_EQ(plan[0].yaw, 0.3);
  EXPECT_EQ(plan[1].x, 1.0);
  EXPECT_EQ(plan[1].yaw, 2.0);
}

TEST_F(Rollout, LeadsToTheSideWhileLookingAround) {
  const std::vector<Pose2>& plan = planFor(situationAt({}, 0.0, test::ring(0.3)), {5.0, 0.0, 1.0});
  EXPECT_EQ(agent_.decision().choice, Decision::Move::kLookAround);
  EXPECT_GT(std::abs(plan[1].yaw), 1.0);
  EXPECT_EQ(plan.back().x, 5.0);
  EXPECT_LE(longestGap(), parameters_.spacing + 1e-9);
}

TEST_F(Rollout, HasABoundedNumberOfPosesHoweverFarTheGoal) {
  for (const double distance : {450.0, kFarthestGoal}) {
    SCOPED_TRACE(distance);
    const std::vector<Pose2>& plan = planFor(situationAt({}), {distance, 0.0, 2.5});
    EXPECT_LE(plan.size(), kMostPlanPoses);
    EXPECT_EQ(plan.back().x, distance);
    EXPECT_EQ(plan.back().yaw, 2.5);
    // As dense as ever near the robot, then evenly spaced.
    for (std::size_t i = 1; i < kMostDensePlanPoses; ++i) {
      ASSERT_LE(distanceBetween(plan[i - 1], plan[i]), parameters_.spacing + 1e-9) << i;
    }
    EXPECT_LE(longestGap(), 1.01 * distance / static_cast<double>(kMostPlanPoses - kMostDensePlanPoses));
  }
}

TEST_F(Rollout, IsDenseToTheEndForOrdinaryDistances) {
  planFor(situationAt({}), {300.0, 200.0, 0.0});
  EXPECT_LE(longestGap(), parameters_.spacing + 1e-9);
}

TEST_F(Rollout, FollowsALongRouteMoreCoarselyFarFromTheRobot) {
  // Rows of 50 m, 1 m apart: 2.6 km.
  Decision decision;
  decision.choice = Leader::kRoute;
  decision.waypoint = {0.4, 0.0};
  for (int row = 0; row < 50; ++row) {
    decision.path_on.push_back({row % 2 == 0 ? 50.0 : 0.0, static_cast<double>(row)});
    decision.path_on.push_back({row % 2 == 0 ? 50.0 : 0.0, row + 1.0});
  }
  decision.destination = decision.path_on.back();
  rollOut(situationAt({}), decision, agent_.shield(), {0.0, 50.0, 1.0}, agent_.parameters(), parameters_, &plan_);
  EXPECT_LE(plan_.size(), kMostPlanPoses);
  EXPECT_EQ(plan_.back().y, 50.0);
  EXPECT_EQ(plan_.back().yaw, 1.0);
  EXPECT_LE(longestGap(), 1.2);
  for (const Pose2& pose : plan_) {
    const bool on_lane = std::abs(pose.y - std::round(pose.y)) < 1e-6;
    ASSERT_TRUE(on_lane || pose.x < 1e-6 || pose.x > 50.0 - 1e-6) << pose.x << ", " << pose.y;
  }
}

TEST_F(Rollout, ForgetsThePlanBefore) {
  planFor(situationAt({}), {20.0, 0.0, 0.0});
  EXPECT_LT(planFor(situationAt({}), {1.0, 0.0, 0.0}).size(), 30u);
}

}  // namespace
}  // namespace lstm_planner::test_rollout
