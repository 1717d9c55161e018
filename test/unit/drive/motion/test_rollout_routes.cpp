#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "lstm_planner/drive/motion/rollout.hpp"
#include "lstm_planner/simulation/generated_world.hpp"
#include "support/agent_steps.hpp"
#include "support/case_name.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/local_map/memory_fixtures.hpp"

namespace lstm_planner::test_rollout_routes {
namespace {

const AgentParameters kDefaults;
const double kRadius = kDefaults.shield.footprint_radius;

/// What the memory's squares may hide of a distance: half a square's diagonal, half a square on paths in between.
const double kBlur = (0.5 * std::sqrt(2.0) + 0.5) * kDefaults.memory.resolution;

/// Plans of an agent that was just put into a forest of poles, with that heading preferred.
class RolloutInForests : public ::testing::TestWithParam<unsigned> {
 protected:
  RolloutInForests() : world_(generateForest(forest(), GetParam())), random_(GetParam()) {}

  static ForestParameters forest() {
    ForestParameters parameters;
    parameters.density = 0.04;
    return parameters;
  }

  Point2 freePlace() {
    std::uniform_real_distribution<double> x(0.5, 11.5);
    std::uniform_real_distribution<double> y(0.5, 9.5);
    Point2 place;
    do {
      place = {x(random_), y(random_)};
    } while (world_.touches(place, kRadius + 0.12));
    return place;
  }

  GridWorld world_;
  std::mt19937 random_;
};

TEST_P(RolloutInForests, IsDenseEndsAtTheGoalAndGoesThroughNothingThatIsKnown) {
  std::uniform_real_distribution<double> yaw(-M_PI, M_PI);
  std::uniform_real_distribution<float> preference(0.0f, 1.0f);
  const RolloutParameters parameters;
  std::vector<Pose2> plan;
  int checked = 0;
  for (int i = 0; i < 40; ++i) {
    std::vector<float> preferences(5);
    for (float& value : preferences) value = preference(random_);
    NavigationAgent agent(test::policyPreferring(preferences), i % 2 == 0 ? kDefaults : test::routeLed());
    const Point2 place = freePlace();
    const Pose2 pose{place.x, place.y, yaw(random_)};
    const Point2 target = freePlace();
    const Pose2 goal{target.x, target.y, yaw(random_)};
    agent.setGoal(target);
    const Situation situation = test::seenFrom(world_, pose);
    const Decision& decision = test::decideIn(situation, &agent);
    rollOut(situation, decision, agent.shield(), goal, kDefaults, parameters, &plan);
    if (decision.choice != Leader::kNetwork && decision.choice != Leader::kRoute) continue;
    ++checked;
    SCOPED_TRACE("plan " + std::to_string(i) + (decision.on_route ? " on the route" : " off the route"));
    // Where a network leads, what lies beyond what is seen to be free is not searched: a straight line to the goal.
    const double known = decision.on_route ? 1e3 : distanceBetween(pose, decision.waypoint);
    EXPECT_EQ(plan.front().x, pose.x);
    EXPECT_EQ(plan.back().x, decision.destination.x);
    EXPECT_EQ(plan.back().y, decision.destination.y);
    EXPECT_EQ(plan.back().yaw, goal.yaw);
    bool left = false;
    for (std::size_t pose_index = 1; pose_index < plan.size(); ++pose_index) {
      const Pose2& at = plan[pose_index];
      ASSERT_LE(distanceBetween(plan[pose_index - 1], at), parameters.spacing + 1e-9);
      // No hairpin on a route: once it has left the robot it does not come by again.
      left = left || distanceBetween(pose, at) > 2.0 * parameters.spacing;
      ASSERT_TRUE(!left || !decision.on_route || distanceBetween(pose, at) > parameters.spacing)
          << "pose " << pose_index;
      for (const Point2& obstacle : situation.obstacles) {
        if (distanceBetween(pose, at) > known) break;
        ASSERT_GT(distanceBetween(toParentFrame(pose, obstacle), at), kRadius - kBlur) << "pose " << pose_index;
      }
    }
  }
  EXPECT_GT(checked, 20);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RolloutInForests, ::testing::Values(1u, 2u, 3u, 4u), test::caseName("Seed"));

TEST(RolloutOnRoutes, GoesRoundAWallThatIsNoLongerInSight) {
  OccupancyGrid grid = test::emptyHall(10.0, 8.0);
  test::fillBox(4.0, 0.0, 4.1, 6.0, &grid);
  const GridWorld world(grid);
  NavigationAgent agent(test::straightAheadPolicy(), test::routeLed());
  agent.setGoal({6.0, 2.0});
  test::decideIn(test::seenFrom(world, {2.0, 2.0, 0.0}), &agent);
  // Turned back by 180 degrees the wall lies in the blind sector.
  const Situation situation = test::seenFrom(world, {2.0, 2.0, M_PI}, 1.0);
  const Decision& decision = test::decideIn(situation, &agent);
  std::vector<Pose2> plan;
  rollOut(situation, decision, agent.shield(), {6.0, 2.0, 1.0}, kDefaults, {}, &plan);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    ASSERT_FALSE(world.touches({plan[i].x, plan[i].y}, kRadius - kBlur)) << "pose " << i;
  }
  EXPECT_EQ(plan.back().x, 6.0);
  EXPECT_EQ(plan.back().yaw, 1.0);
}

TEST(RolloutOnRoutes, EndsBesideAGoalThatLiesInSomething) {
  AgentParameters tolerant = test::routeLed();
  tolerant.goal_tolerance = 0.6;
  NavigationAgent agent(test::straightAheadPolicy(), tolerant);
  agent.setGoal({4.0, 0.1});
  std::vector<Point2> pillar;
  for (const Point2& point : test::ring(0.2)) pillar.push_back({4.0 + point.x, 0.1 + point.y});
  const Situation situation = test::returnsAt(pillar);
  const Decision& decision = test::decideIn(situation, &agent);
  std::vector<Pose2> plan;
  rollOut(situation, decision, agent.shield(), {4.0, 0.1, 2.0}, tolerant, {}, &plan);
  EXPECT_EQ(plan.back().x, decision.destination.x);
  EXPECT_EQ(plan.back().yaw, 2.0);
  for (const Pose2& pose : plan) {
    ASSERT_GT(distanceBetween(pose, Point2{4.0, 0.1}), 0.2 + kRadius - kBlur);
  }
}

}  // namespace
}  // namespace lstm_planner::test_rollout_routes
