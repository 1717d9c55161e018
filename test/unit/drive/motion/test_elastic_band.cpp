#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lstm_planner/drive/motion/elastic_band.hpp"
#include "lstm_planner/drive/motion/rollout.hpp"
#include "lstm_planner/simulation/generated_world.hpp"
#include "support/agent_steps.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/local_map/memory_fixtures.hpp"

namespace lstm_planner::test_elastic_band {
namespace {

const AgentParameters kDefaults;
const double kRadius = kDefaults.shield.footprint_radius;
constexpr double kClearance = 0.33;
constexpr double kSquare = 0.05;  // m, of the memory: what it sees is so blurred

/// A hall with a wall across, at x = 3, that has a door from y = 2.0 to 2.9.
class ElasticBandAtADoor : public ::testing::Test {
 protected:
  static constexpr double kDoor = 2.45;  // its middle
  static constexpr double kWall = 3.05;

  ElasticBandAtADoor() : world_(hall()), agent_(test::straightAheadPolicy(), test::routeLed()) {}

  static OccupancyGrid hall() {
    OccupancyGrid grid = test::emptyHall(7.0, 6.0);
    test::fillBox(3.0, 0.0, 3.1, 2.0, &grid);
    test::fillBox(3.0, 2.9, 3.1, 6.0, &grid);
    return grid;
  }

  /// The agent's plan; `clearance` is what it is bent to.
  std::vector<Pose2> plan(const Pose2& pose, const Pose2& goal, double clearance) {
    agent_.setGoal({goal.x, goal.y});
    const Situation situation = test::seenFrom(world_, pose);
    const Decision& decision = test::decideIn(situation, &agent_);
    std::vector<Pose2> plan;
    rollOut(situation, bentAway(agent_, pose, decision, clearance).value_or(decision), agent_.shield(), goal,
            agent_.parameters(), {}, &plan);
    return plan;
  }

  /// y where a plan crosses the wall.
  static double crossing(const std::vector<Pose2>& plan) {
    const auto beyond = std::find_if(plan.begin(), plan.end(), [](const Pose2& pose) { return pose.x >= kWall; });
    return beyond == plan.end() ? 0.0 : beyond->y;
  }

  static double sharpestTurn(const std::vector<Pose2>& plan) {
    double sharpest = 0.0;
    for (std::size_t i = 2; i + 1 < plan.size(); ++i) {
      sharpest = std::max(sharpest, std::abs(normalizeAngle(plan[i].yaw - plan[i - 1].yaw)));
    }
    return sharpest;
  }

  GridWorld world_;
  NavigationAgent agent_;
};

constexpr double ElasticBandAtADoor::kDoor;
constexpr double ElasticBandAtADoor::kWall;

TEST_F(ElasticBandAtADoor, LeadsThroughTheMiddle) {
  const Pose2 pose{1.8, 0.9, M_PI_4};
  const Pose2 goal{4.6, 1.0, 0.0};
  // Between the posts there is no room for the clearance: the shortest path keeps to the near one.
  EXPECT_LT(crossing(plan(pose, goal, 0.0)), kDoor - 0.08);
  EXPECT_NEAR(crossing(plan(pose, goal, kClearance)), kDoor, kSquare);
}

TEST_F(ElasticBandAtADoor, GoesRoundThePostInAnArc) {
  const Pose2 pose{1.8, 0.9, M_PI_4};
  const Pose2 goal{4.6, 1.0, 0.0};
  // Of two straight pieces that meet at the post the second turns by all at once; in an arc of at least 0.3 m, 5 cm
  // between poses are a sixth of a radian, and the points of the chain are twice as far apart.
  EXPECT_GT(sharpestTurn(plan(pose, goal, 0.0)), 0.5);
  EXPECT_LT(sharpestTurn(plan(pose, goal, kClearance)), 0.4);
}

TEST_F(ElasticBandAtADoor, BendsNoStepOfTheNetworkButWhatComesBehindIt) {
  AgentParameters parameters;
  parameters.detour.allowance = 10.0;
  NavigationAgent agent(test::straightAheadPolicy(), parameters);
  const Pose2 pose{1.8, 0.9, 0.0};
  agent.setGoal({4.6, 1.0});
  const Situation situation = test::seenFrom(world_, pose);
  const Decision& decision = test::decideIn(situation, &agent);
  ASSERT_EQ(decision.choice, Leader::kNetwork);
  ASSERT_FALSE(decision.on_route);
  std::vector<Pose2> plan;
  rollOut(situation, bentAway(agent, pose, decision, kClearance).value(), agent.shield(), {4.6, 1.0, 0.0}, parameters,
          {}, &plan);
  const double to_waypoint = distanceBetween(pose, decision.waypoint);
  for (const Pose2& on_plan : plan) {
    const double along = distanceBetween(pose, on_plan);
    if (along > to_waypoint) break;
    EXPECT_LT(distanceBetween(on_plan, pointAlong(Point2{pose.x, pose.y}, decision.direction, along)), 1e-9);
  }
  EXPECT_NEAR(crossing(plan), kDoor, kSquare);
}

TEST_F(ElasticBandAtADoor, StaysDenseFromThePoseToTheGoalAndPassable) {
  const Pose2 pose{1.8, 0.9, M_PI_4};
  const Pose2 goal{5.5, 4.6, 1.0};
  const std::vector<Pose2> bent = plan(pose, goal, kClearance);
  EXPECT_EQ(bent.front().x, pose.x);
  EXPECT_EQ(bent.front().yaw, pose.yaw);
  EXPECT_EQ(bent.back().x, goal.x);
  EXPECT_EQ(bent.back().y, goal.y);
  EXPECT_EQ(bent.back().yaw, goal.yaw);
  for (std::size_t i = 1; i < bent.size(); ++i) {
    ASSERT_LE(distanceBetween(bent[i - 1], bent[i]), 0.05 + 1e-9) << i;
    ASSERT_FALSE(world_.touches({bent[i].x, bent[i].y}, kRadius)) << i;
  }
}

TEST_F(ElasticBandAtADoor, LeavesARobotBesideAWallInAnArc) {
  // 0.25 m from the wall, along which the way leads. Pushed at once the path would begin at a right angle.
  const Pose2 pose{2.75, 0.6, M_PI_2};
  const std::vector<Pose2> bent = plan(pose, {4.6, 4.0, 0.0}, kClearance);
  ASSERT_GT(bent.size(), 10u);
  EXPECT_LT(std::abs(normalizeAngle(directionTo(bent[0], bent[4]) - pose.yaw)), M_PI / 3.0);
  EXPECT_NEAR(crossing(bent), kDoor, kSquare);
}

TEST_F(ElasticBandAtADoor, BendsTheWayToAGoalInSight) {
  // The straight way there passes the post 0.3 m from the middle of the robot.
  const Pose2 pose{2.6, 2.3, 0.0};
  const Pose2 goal{3.8, 2.3, 0.0};
  EXPECT_NEAR(crossing(plan(pose, goal, 0.0)), 2.3, 1e-6);
  EXPECT_EQ(agent_.decision().choice, Decision::Move::kGoalInSight);
  EXPECT_GT(crossing(plan(pose, goal, kClearance)), 2.3 + 0.05);
}

TEST_F(ElasticBandAtADoor, KeepsTheClearanceWhereThereIsRoom) {
  // Round the free end of a wall.
  OccupancyGrid grid = test::emptyHall(8.0, 8.0);
  test::fillBox(4.0, 0.0, 4.1, 3.0, &grid);
  world_ = GridWorld(grid);
  double nearest = 10.0;
  for (const Pose2& pose : plan({2.0, 2.0, 0.5}, {6.0, 2.0, 0.0}, kClearance)) {
    nearest = std::min(nearest, distanceBetween(pose, Point2{4.05, 3.0}));
  }
  // Drawn straight it comes a fifth nearer at most; the shortest path comes to memory/comfort.
  EXPECT_GT(nearest, 0.8 * (kRadius + kClearance));
  EXPECT_LT(nearest, kRadius + kClearance + 0.15);
}

TEST_F(ElasticBandAtADoor, LeavesAloneWhatFollowsNoPath) {
  AgentParameters forgetful;
  forgetful.memory.enabled = false;
  NavigationAgent agent(test::straightAheadPolicy(), forgetful);
  agent.setGoal({4.6, 1.0});
  const Pose2 pose{1.8, 0.9, M_PI_4};
  const Decision& decision = test::decideIn(test::seenFrom(world_, pose), &agent);
  ASSERT_EQ(decision.choice, Leader::kNetwork);
  EXPECT_FALSE(bentAway(agent, pose, decision, kClearance));
}

TEST_F(ElasticBandAtADoor, LeavesEverythingAloneWithoutClearance) {
  agent_.setGoal({4.6, 1.0});
  const Pose2 pose{1.8, 0.9, M_PI_4};
  const Decision& decision = test::decideIn(test::seenFrom(world_, pose), &agent_);
  EXPECT_FALSE(bentAway(agent_, pose, decision, 0.0));
  EXPECT_TRUE(bentAway(agent_, pose, decision, kClearance));
}

}  // namespace
}  // namespace lstm_planner::test_elastic_band
