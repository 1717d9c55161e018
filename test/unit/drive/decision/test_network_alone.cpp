#include <gtest/gtest.h>

#include <set>
#include <string>

#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "support/agent_steps.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_network_alone {
namespace {

using test::situationAt;

constexpr int kStraight = 2;

/// A network that leads without boundary following and without a memory of obstacles.
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

  /// Makes so many steps forth and back, in the open; returns the actions.
  std::set<int> stepToAndFro(const Pose2& place, int steps, NavigationAgent* agent) {
    std::set<int> actions;
    for (int i = 0; i < steps; ++i) {
      const Pose2 pose{place.x, place.y + (i % 2 == 0 ? 0.05 : -0.05), place.yaw};
      actions.insert(test::decideIn(situationAt(pose, time_ += 1.0), agent).action);
    }
    return actions;
  }

  AgentParameters parameters_;
  double time_ = 0.0;
};

TEST_F(NetworkAloneTest, DrawsItsStepsOnceItHasMadeNoProgressForLong) {
  NavigationAgent agent = agentTo({10.0, 0.0});
  EXPECT_EQ(stepToAndFro({}, parameters_.draw_after, &agent), std::set<int>{kStraight});
  EXPECT_EQ(stepToAndFro({}, 100, &agent), (std::set<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(agent.decision().overruled, Overruled::kNo) << "what was drawn is the network's answer";
}

TEST_F(NetworkAloneTest, DrawsNothingIfItIsNotAllowed) {
  parameters_.draw_after = 0;
  NavigationAgent agent = agentTo({10.0, 0.0});
  EXPECT_EQ(stepToAndFro({}, 200, &agent), std::set<int>{kStraight});
}

TEST_F(NetworkAloneTest, DrawsNothingWhereObstaclesAreRemembered) {
  parameters_.memory.enabled = true;
  NavigationAgent agent = agentTo({10.0, 0.0});
  EXPECT_EQ(stepToAndFro({}, parameters_.draw_after + 100, &agent), std::set<int>{kStraight});
}

TEST_F(NetworkAloneTest, DrawsOnceAStepHoweverOftenItIsAsked) {
  NavigationAgent agent = agentTo({10.0, 0.0});
  stepToAndFro({}, parameters_.draw_after, &agent);
  for (int step = 0; step < 20; ++step) {
    stepToAndFro({0.1 * (step % 2), 0.0, 0.0}, 1, &agent);
    const Decision first = agent.decision();
    const Decision& again = test::decideIn(situationAt({0.1 * (step % 2), 0.05, 0.0}, time_ + 0.1), &agent);
    EXPECT_EQ(again.step, first.step);
    EXPECT_EQ(again.action, first.action);
  }
}

}  // namespace
}  // namespace lstm_planner::test_network_alone
