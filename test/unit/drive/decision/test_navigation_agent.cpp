#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "support/agent_steps.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/local_map/memory_fixtures.hpp"

namespace lstm_planner::test_navigation_agent {
namespace {

using Move = Decision::Move;
using test::situationAt;

constexpr int kRight = 0;
constexpr int kStraight = 2;
constexpr int kLeft = 4;

/// Prefers straight on, then to the left, then to the right.
class NavigationAgentTest : public ::testing::Test {
 protected:
  NavigationAgentTest() : agent_(policy(), parameters()) { agent_.setGoal({10.0, 0.0}); }

  /// That allow every detour of the network.
  static AgentParameters parameters() {
    AgentParameters parameters;
    parameters.detour.allowance = 1000.0;
    return parameters;
  }

  static DrivePolicy policy() { return test::policyPreferring({1.0f, 2.0f, 5.0f, 3.0f, 4.0f}); }
  Network::HiddenState hiddenState() const { return agent_.policy().hiddenState(); }

  /// Whether the agent makes a new step when it finds the robot there, after a first step at the origin at time 0.
  bool stepsAnew(const Pose2& pose, double time) {
    agent_.setGoal({10.0, 0.0});
    test::decideIn(situationAt({}), &agent_);
    const Network::HiddenState before = hiddenState();
    const long step = agent_.decision().step;
    test::decideIn(situationAt(pose, time), &agent_);
    const bool advanced = hiddenState() != before;
    EXPECT_EQ(advanced, agent_.decision().step == step + 1);
    return advanced;
  }

  NavigationAgent agent_;
};

/// 7.6 cm before the footprint, from far right to far left: only the paths along it are free.
std::vector<Point2> wallAhead() { return test::wall({0.25, -1.0}, {0.25, 1.0}); }

TEST_F(NavigationAgentTest, GoesOneStepInThePreferredDirection) {
  const Decision& decision = test::decideIn(situationAt({1.0, 2.0, M_PI_2}), &agent_);
  EXPECT_EQ(decision.choice, Leader::kNetwork);
  EXPECT_EQ(decision.action, kStraight);
  EXPECT_EQ(decision.step, 1);
  EXPECT_NEAR(decision.direction, M_PI_2, 1e-12);
  EXPECT_NEAR(decision.waypoint.x, 1.0, 1e-12);
  EXPECT_NEAR(decision.waypoint.y, 2.4, 1e-12);
}

TEST_F(NavigationAgentTest, AskingTwiceGivesTheSameAnswer) {
  const Decision first = test::decideIn(situationAt({}), &agent_);
  const Network::HiddenState before = hiddenState();
  for (int i = 1; i < 10; ++i) {
    const Decision& again = test::decideIn(situationAt({}, 0.01 * i), &agent_);
    EXPECT_EQ(again.choice, first.choice);
    EXPECT_EQ(again.action, first.action);
    EXPECT_EQ(again.step, first.step);
    EXPECT_EQ(again.waypoint.x, first.waypoint.x);
    EXPECT_EQ(again.waypoint.y, first.waypoint.y);
  }
  EXPECT_EQ(hiddenState(), before);
}

TEST_F(NavigationAgentTest, GoesNowhereWhereACostmapHasAnObstacle) {
  Situation situation = situationAt({});
  situation.marked = wallAhead();
  EXPECT_NE(test::decideIn(situation, &agent_).action, kStraight);
  situation.marked.clear();
  agent_.setGoal({10.0, 0.0});
  EXPECT_EQ(test::decideIn(situation, &agent_).action, kStraight) << "cleared";
}

TEST_F(NavigationAgentTest, StepsAfterHalfASecondOnlyIfTheRobotHasMoved) {
  EXPECT_FALSE(stepsAnew({}, 0.6));
  EXPECT_FALSE(stepsAnew({0.01, 0.0, 0.02}, 0.6));  // less than odometry noise may feign
  EXPECT_FALSE(stepsAnew({0.03, 0.0, 0.0}, 0.4));
  EXPECT_TRUE(stepsAnew({0.03, 0.0, 0.0}, 0.5));
  EXPECT_TRUE(stepsAnew({0.0, 0.0, 0.06}, 0.5));
}

TEST_F(NavigationAgentTest, StepsAfterAStepLengthOrATurnAtOnce) {
  EXPECT_FALSE(stepsAnew({0.0, 0.39, 0.0}, 0.1));
  EXPECT_TRUE(stepsAnew({0.0, 0.4, 0.0}, 0.1));
  EXPECT_FALSE(stepsAnew({0.0, 0.0, 0.78}, 0.1));
  EXPECT_TRUE(stepsAnew({0.0, 0.0, -0.79}, 0.1));
  EXPECT_TRUE(stepsAnew({0.36, 0.0, 0.0}, 0.1));  // at the waypoint
}

TEST_F(NavigationAgentTest, GoesOnSteppingWhenTheClockJumpsBack) {
  test::decideIn(situationAt({}, 1000.0), &agent_);
  test::decideIn(situationAt({0.1, 0.0, 0.0}, 3.0), &agent_);
  EXPECT_EQ(agent_.decision().step, 2);
}

TEST_F(NavigationAgentTest, ForgetsEverythingAtANewGoal) {
  const Decision first = test::decideIn(situationAt({}), &agent_);
  const Network::HiddenState after_first = hiddenState();
  for (int i = 1; i < 5; ++i) {
    test::decideIn(situationAt({0.4 * i, 0.0, 0.0}, i), &agent_);
  }
  agent_.setGoal({10.0, 0.0});
  EXPECT_TRUE(hiddenState().isZero(0.0f));
  const Decision& again = test::decideIn(situationAt({}, 9.0), &agent_);
  EXPECT_EQ(hiddenState(), after_first);
  EXPECT_EQ(again.step, first.step);
  EXPECT_DOUBLE_EQ(agent_.bestDistance(), 10.0);
}

TEST_F(NavigationAgentTest, AGoalThatMovesALittleIsFollowedAndNothingIsForgotten) {
  test::decideIn(situationAt({}), &agent_);
  test::decideIn(situationAt({0.4, 0.0, 0.0}, 1.0), &agent_);
  const Network::HiddenState before = hiddenState();
  const Decision decided = agent_.decision();
  const Point2 goal{10.1, 0.2};
  agent_.moveGoal(goal);
  EXPECT_EQ(agent_.goal().x, goal.x);
  EXPECT_EQ(agent_.goal().y, goal.y);
  const Decision& decision = test::decideIn(situationAt({0.4, 0.0, 0.0}, 1.1), &agent_);
  EXPECT_EQ(hiddenState(), before);
  EXPECT_EQ(decision.step, decided.step);
  EXPECT_EQ(decision.action, decided.action);
  EXPECT_EQ(decision.waypoint.x, decided.waypoint.x);
  EXPECT_EQ(decision.destination.x, goal.x);
  EXPECT_EQ(decision.destination.y, goal.y);
}

TEST_F(NavigationAgentTest, ARouteEndsAtAGoalThatMovesALittle) {
  NavigationAgent agent(policy(), test::routeLed());
  agent.setGoal({10.0, 0.0});
  test::decideIn(situationAt({}), &agent);
  const Point2 goal{10.1, 0.2};
  agent.moveGoal(goal);
  const Decision& decision = test::decideIn(situationAt({}, 0.1), &agent);
  ASSERT_FALSE(decision.path_on.empty());
  EXPECT_EQ(decision.path_on.back().x, goal.x);
  EXPECT_EQ(decision.path_on.back().y, goal.y);
}

TEST_F(NavigationAgentTest, AGoalThatMovesTowardsTheRobotIsNoProgress) {
  const double progress = AgentParameters{}.escape.progress;
  test::decideIn(situationAt({}), &agent_);
  double goal = 10.0;
  for (int i = 1; i <= 10; ++i) {
    goal -= 0.2;
    agent_.moveGoal({goal, 0.0});
    test::decideIn(situationAt({0.9 * progress, 0.0, 0.0}, i), &agent_);
    EXPECT_DOUBLE_EQ(agent_.bestDistance(), goal) << "from where the robot was at first";
  }
  test::decideIn(situationAt({1.1 * progress, 0.0, 0.0}, 11.0), &agent_);
  EXPECT_DOUBLE_EQ(agent_.bestDistance(), goal - 1.1 * progress);
}

TEST_F(NavigationAgentTest, AGoalInSightIsFollowedAtOnce) {
  agent_.setGoal({1.0, -1.0});
  test::decideIn(situationAt({}), &agent_);
  agent_.moveGoal({1.2, -1.0});
  const Decision& decision = test::decideIn(situationAt({}, 0.1), &agent_);
  EXPECT_EQ(decision.choice, Move::kGoalInSight);
  EXPECT_EQ(decision.step, 1);
  EXPECT_EQ(decision.waypoint.x, 1.2);
  EXPECT_EQ(decision.waypoint.y, -1.0);
  EXPECT_DOUBLE_EQ(decision.direction, std::atan2(-1.0, 1.2));
}

TEST_F(NavigationAgentTest, HasArrivedWhereTheGoalMovedTo) {
  agent_.setGoal({1.0, 0.0});
  EXPECT_EQ(test::decideIn(situationAt({0.7, 0.0, 0.0}), &agent_).choice, Move::kGoalInSight);
  agent_.moveGoal({0.8, 0.0});
  EXPECT_EQ(test::decideIn(situationAt({0.7, 0.0, 0.0}, 0.1), &agent_).choice, Move::kArrived);
}

TEST_F(NavigationAgentTest, PreviewChangesNothing) {
  test::decideIn(situationAt({}), &agent_);
  const Network::HiddenState before = hiddenState();
  int calls = 0;
  agent_.setStepListener([&calls](const Situation&, const Observation&) {
    ++calls;
    return std::optional<int>();
  });
  test::previewIn(situationAt({3.0, 1.0, 1.0}, 5.0), {-4.0, 2.0}, agent_);
  EXPECT_EQ(hiddenState(), before);
  EXPECT_EQ(agent_.decision().step, 1);
  EXPECT_EQ(agent_.goal().x, 10.0);
  EXPECT_EQ(calls, 0);
}

TEST_F(NavigationAgentTest, PreviewAnswersAsAFreshAgentWould) {
  for (int i = 0; i < 6; ++i) {
    test::decideIn(situationAt({0.4 * i, 0.0, 0.0}, i), &agent_);
  }
  const Situation situation = situationAt({3.0, 1.0, 1.0}, 9.0, wallAhead());
  const Point2 goal{-4.0, 2.0};
  const Decision preview = test::previewIn(situation, goal, agent_);
  NavigationAgent fresh(policy(), parameters());
  fresh.setGoal(goal);
  const Decision& expected = test::decideIn(situation, &fresh);
  EXPECT_EQ(preview.choice, expected.choice);
  EXPECT_EQ(preview.action, expected.action);
  EXPECT_EQ(preview.step, expected.step);
  EXPECT_EQ(preview.waypoint.x, expected.waypoint.x);
  EXPECT_EQ(preview.waypoint.y, expected.waypoint.y);
  EXPECT_EQ(preview.preferences, expected.preferences);
  EXPECT_EQ(preview.allowed, expected.allowed);
}

TEST_F(NavigationAgentTest, ShieldMasksThePreferredActionBeforeAWall) {
  const Decision& decision = test::decideIn(situationAt({}, 0.0, wallAhead()), &agent_);
  EXPECT_EQ(decision.allowed, (std::vector<char>{1, 0, 0, 0, 1}));
  EXPECT_EQ(decision.action, kLeft);  // preferred to the right
  EXPECT_EQ(decision.choice, Leader::kNetwork);
}

TEST_F(NavigationAgentTest, ChoosesAnewWithoutSteppingWhenThePathIsBlocked) {
  test::decideIn(situationAt({}), &agent_);
  const Network::HiddenState before = hiddenState();
  const Decision& decision = test::decideIn(situationAt({}, 0.1, wallAhead()), &agent_);
  EXPECT_EQ(decision.action, kLeft);
  EXPECT_EQ(decision.step, 1);
  EXPECT_EQ(hiddenState(), before);
}

TEST_F(NavigationAgentTest, ShortensAStepWhoseEndIsBlocked) {
  ASSERT_NEAR(test::decideIn(situationAt({}), &agent_).waypoint.x, 0.4, 1e-3);
  // 10 cm before the end of the step it comes as near to the wall as it may where there is room.
  const ShieldParameters shield;
  const double wall = 0.3 + shield.footprint_radius + shield.clearance;
  const Decision& decision = test::decideIn(situationAt({}, 0.1, test::wall({wall, -1.0}, {wall, 1.0})), &agent_);
  EXPECT_EQ(decision.action, kStraight);
  EXPECT_EQ(decision.step, 1);
  EXPECT_NEAR(decision.waypoint.x, 0.3, 1e-3) << "returns are a centimetre apart";
}

TEST_F(NavigationAgentTest, ARestartForgetsWhatIsOutOfView) {
  AgentParameters with_corners = parameters();
  with_corners.shield.footprint = "[[0.3, 0.2], [0.3, -0.2], [-0.3, -0.2], [-0.3, 0.2]]";
  with_corners.shield.footprint_radius = 0.2;
  NavigationAgent agent(policy(), with_corners);
  const CircleWorld post({{{0.6, 0.0}, 0.1}});
  const Situation behind = test::seenFrom(post, {0.0, 0.0, M_PI});
  agent.perceive(test::seenFrom(post, {}));
  agent.perceive(behind);
  EXPECT_NEAR(agent.shield().gap({}), 0.2, 0.01) << "the scanner does not see behind";
  agent.restart();
  agent.perceive(behind);
  EXPECT_EQ(agent.shield().gap({}), with_corners.shield.reach);
}

TEST_F(NavigationAgentTest, UsesTheTightClearanceWhereThereIsNoOtherPath) {
  // A passage 0.44 m wide and closed behind: 4.6 cm on either side of the robot.
  std::vector<Point2> passage = test::wall({-0.24, 0.22}, {2.0, 0.22});
  for (const Point2& point : test::wall({-0.24, -0.22}, {2.0, -0.22})) passage.push_back(point);
  const Decision& decision = test::decideIn(situationAt({}, 0.0, passage), &agent_);
  EXPECT_EQ(decision.choice, Leader::kNetwork);
  EXPECT_EQ(decision.action, kStraight);
}

TEST_F(NavigationAgentTest, LooksAroundWhenNoActionIsFree) {
  const Decision& decision = test::decideIn(situationAt({}, 0.0, test::ring(0.3)), &agent_);
  EXPECT_EQ(decision.choice, Move::kLookAround);
  EXPECT_EQ(decision.action, -1);
  EXPECT_GT(std::abs(decision.direction), 1.0);  // well off the heading, or the robot would not turn
}

TEST_F(NavigationAgentTest, LooksAroundTowardsTheGoal) {
  agent_.setGoal({0.0, -10.0});
  EXPECT_LT(test::decideIn(situationAt({}, 0.0, test::ring(0.3)), &agent_).direction, 0.0);
  agent_.setGoal({0.0, 10.0});
  EXPECT_GT(test::decideIn(situationAt({}, 0.0, test::ring(0.3)), &agent_).direction, 0.0);
}

TEST_F(NavigationAgentTest, LooksAroundWhenTheRobotStandsStillAndNothingIsRemembered) {
  AgentParameters parameters;
  parameters.memory.enabled = false;
  NavigationAgent agent(policy(), parameters);
  agent.setGoal({10.0, 0.0});
  test::decideIn(situationAt({}), &agent);
  EXPECT_EQ(test::decideIn(situationAt({}, 1.9), &agent).choice, Leader::kNetwork);
  EXPECT_EQ(test::decideIn(situationAt({0.005, 0.0, 0.0}, 2.1), &agent).choice, Move::kLookAround);
}

TEST_F(NavigationAgentTest, TakesAGoalInSightStraight) {
  agent_.setGoal({1.0, -1.0});
  const Decision& decision = test::decideIn(situationAt({}), &agent_);
  EXPECT_EQ(decision.choice, Move::kGoalInSight);
  EXPECT_NEAR(decision.direction, -M_PI_4, 1e-12);
  EXPECT_NEAR(decision.waypoint.x, 1.0, 1e-12);
  EXPECT_NEAR(decision.waypoint.y, -1.0, 1e-12);
}

TEST_F(NavigationAgentTest, AGoalBeyondWhatTheShieldSeesIsNotInSight) {
  AgentParameters far = parameters();
  far.goal_in_sight = 20.0;
  far.shield.reach = 3.0;
  NavigationAgent agent(policy(), far);
  // The wall lies beyond the reach.
  const Situation situation = situationAt({}, 0.0, test::wall({3.5, -1.0}, {3.5, 1.0}));
  agent.setGoal({4.0, 0.0});
  EXPECT_EQ(test::decideIn(situation, &agent).choice, Leader::kNetwork);
  agent.setGoal({2.5, 0.0});
  EXPECT_EQ(test::decideIn(situation, &agent).choice, Move::kGoalInSight);
}

TEST_F(NavigationAgentTest, LeavesAGoalBehindAWallToTheLeader) {
  agent_.setGoal({1.0, -1.0});
  EXPECT_NE(test::decideIn(situationAt({}, 0.0, test::wall({0.7, -1.5}, {0.7, 1.5})), &agent_).choice,
            Move::kGoalInSight);
}

TEST_F(NavigationAgentTest, HasArrivedWithinTheTolerance) {
  agent_.setGoal({0.1, 0.1});
  EXPECT_EQ(test::decideIn(situationAt({}), &agent_).choice, Move::kArrived);
  EXPECT_EQ(test::decideIn(situationAt({-0.1, 0.1, 0.0}, 0.1), &agent_).choice, Move::kGoalInSight);
}

TEST_F(NavigationAgentTest, WithoutShieldTheNetworkIsFree) {
  AgentParameters parameters;
  parameters.memory.enabled = false;
  parameters.shield_enabled = false;
  NavigationAgent agent(policy(), parameters);
  agent.setGoal({10.0, 0.0});
  const Decision& decision = test::decideIn(situationAt({}, 0.0, wallAhead()), &agent);
  EXPECT_EQ(decision.action, kStraight);
  EXPECT_EQ(decision.allowed, std::vector<char>(5, 1));
}

TEST_F(NavigationAgentTest, StepListenerHearsEachStepOnceAndMayImposeAnAction) {
  int calls = 0;
  agent_.setStepListener([&calls](const Situation&, const Observation& observation) -> std::optional<int> {
    EXPECT_EQ(observation.previous_action, calls == 0 ? 0.0 : -M_PI_2);
    ++calls;
    return kRight;
  });
  EXPECT_EQ(test::decideIn(situationAt({}), &agent_).action, kRight);
  EXPECT_EQ(test::decideIn(situationAt({}, 0.1), &agent_).action, kRight);
  EXPECT_EQ(calls, 1);
  test::decideIn(situationAt({0.0, -0.4, 0.0}, 1.0), &agent_);
  EXPECT_EQ(calls, 2);
}

TEST_F(NavigationAgentTest, AnImposedActionHoldsForItsStepOnly) {
  int calls = 0;
  agent_.setStepListener([&calls](const Situation&, const Observation&) {
    return calls++ == 0 ? std::optional<int>(kRight) : std::nullopt;
  });
  EXPECT_EQ(test::decideIn(situationAt({}), &agent_).action, kRight);
  EXPECT_EQ(test::decideIn(situationAt({0.0, -0.4, 0.0}, 1.0), &agent_).action, kStraight);
}

TEST_F(NavigationAgentTest, AnImposedActionStillHasToPassTheShield) {
  agent_.setStepListener([](const Situation&, const Observation&) { return std::optional<int>(kStraight); });
  EXPECT_EQ(test::decideIn(situationAt({}, 0.0, wallAhead()), &agent_).action, kLeft);
}

TEST_F(NavigationAgentTest, ANetworkThatLeadsNoMorePrefersNothing) {
  EXPECT_EQ(test::decideIn(situationAt({}), &agent_).preferred, kStraight);
  AgentParameters changed = parameters();
  changed.leader = Leader::kGreedy;
  agent_.change(changed);
  agent_.moveGoal({0.0, 10.0});
  const Decision& decision = test::decideIn(situationAt({0.4, 0.0, 0.0}, 1.0), &agent_);
  EXPECT_EQ(decision.choice, Leader::kGreedy);
  EXPECT_EQ(decision.preferred, -1);
  EXPECT_EQ(decision.overruled, Overruled::kNo);
}

}  // namespace
}  // namespace lstm_planner::test_navigation_agent
