#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "support/agent_steps.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/local_map/memory_fixtures.hpp"

namespace lstm_planner::test_network_under_bound {
namespace {

using test::returnsAt;
using test::situationAt;

constexpr int kStraight = 2;
constexpr int kLeft = 4;
const Point2 kGoal{4.0, 0.0};
constexpr DetourParameters kBound{0.5, 0.05};

NavigationAgent agentPreferring(const std::vector<float>& preferences, const DetourParameters& detour = kBound) {
  AgentParameters parameters;
  parameters.detour = detour;
  NavigationAgent agent(test::policyPreferring(preferences), parameters);
  agent.setGoal(kGoal);
  return agent;
}
const std::vector<float> kPrefersStraight{0.0f, 0.0f, 1.0f, 0.0f, 0.0f};
const std::vector<float> kPrefersLeft{0.0f, 0.0f, 0.0f, 0.0f, 1.0f};

/// Across the straight path; its right end is the nearer one.
const std::vector<Point2> kWall = test::wall({2.0, -1.0}, {2.0, 3.0});

TEST(NetworkUnderBound, AChoiceInTheDirectionOfThePathIsMadeExactByThePath) {
  NavigationAgent agent = agentPreferring(kPrefersStraight);
  // The nearest steering angle to -0.3 rad is straight on.
  const Decision& decision = test::decideIn(situationAt({0.0, 0.0, 0.3}), &agent);
  EXPECT_EQ(decision.choice, Leader::kNetwork);
  EXPECT_EQ(decision.action, kStraight);
  EXPECT_TRUE(decision.on_route);
  EXPECT_NEAR(decision.waypoint.x, 0.4, 1e-12);
  EXPECT_NEAR(decision.waypoint.y, 0.0, 1e-12);
  EXPECT_EQ(decision.regret_used, 0.0);
  EXPECT_EQ(decision.overruled, Overruled::kNo);
}

TEST(NetworkUnderBound, ADetourWithinTheBoundIsCarriedOut) {
  NavigationAgent agent = agentPreferring(kPrefersLeft);
  const Decision& decision = test::decideIn(situationAt({}), &agent);
  EXPECT_EQ(decision.choice, Leader::kNetwork);
  EXPECT_EQ(decision.action, kLeft);
  EXPECT_FALSE(decision.on_route);
  // 0.4 m aside, and hardly more than before from there; a path from cell to cell is up to 8 % longer.
  EXPECT_NEAR(decision.regret, 0.4 + std::hypot(4.0, 0.4) - 4.0, 0.08 * 0.4);
  EXPECT_EQ(decision.regret_used, decision.regret);
  EXPECT_DOUBLE_EQ(decision.regret_allowed, kBound.allowance);
  ASSERT_FALSE(decision.path_on.empty()) << "the plan goes on to the goal";
  EXPECT_EQ(distanceBetween(decision.path_on.back(), kGoal), 0.0);
}

TEST(NetworkUnderBound, ADetourBeyondTheBoundIsOverruledByThePath) {
  NavigationAgent agent = agentPreferring(kPrefersLeft);
  test::decideIn(situationAt({}), &agent);
  const double used = agent.decision().regret_used;
  // Left again would be straight back: 0.8 m.
  const Decision& decision = test::decideIn(situationAt({0.0, 0.4, M_PI_2}, 1.0), &agent);
  EXPECT_EQ(decision.choice, Leader::kRoute);
  EXPECT_EQ(decision.overruled, Overruled::kByBound);
  EXPECT_EQ(decision.preferred, kLeft);
  EXPECT_TRUE(decision.on_route);
  EXPECT_GT(decision.regret, 0.7);
  EXPECT_EQ(decision.regret_used, used) << "what is not carried out is not counted";
}

TEST(NetworkUnderBound, ATurnOnTheSpotCountsAsAPartOfTheDetour) {
  NavigationAgent agent = agentPreferring(kPrefersLeft);
  const double detour = test::decideIn(situationAt({}), &agent).regret_used;
  ASSERT_GT(detour, 0.0);
  const Decision& decision = test::decideIn(situationAt({0.0, 0.0, M_PI_2}, 1.0), &agent);
  ASSERT_EQ(decision.overruled, Overruled::kByBound);
  EXPECT_NEAR(decision.regret_used, 0.5 * detour, 1e-9) << "a turn by 180 degrees counts as all of it";
}

TEST(NetworkUnderBound, AskingAgainCountsADetourOnce) {
  NavigationAgent agent = agentPreferring(kPrefersLeft);
  const double used = test::decideIn(situationAt({}), &agent).regret_used;
  for (int i = 1; i < 5; ++i) EXPECT_EQ(test::decideIn(situationAt({}, 0.1 * i), &agent).regret_used, used);
  // The step's path is blocked: it is decided anew, in the same step.
  std::vector<Point2> beside = test::wall({-1.0, 0.3}, {1.0, 0.3});
  EXPECT_EQ(test::decideIn(situationAt({}, 0.5, beside), &agent).step, 1);
  EXPECT_LE(agent.decision().regret_used, agent.decision().regret) << "of the new choice alone";
}

TEST(NetworkUnderBound, TheBoundGrowsWithTheDrivenDistance) {
  NavigationAgent agent = agentPreferring(kPrefersStraight, {0.2, 0.1});
  for (int step = 0; step <= 5; ++step) test::decideIn(situationAt({0.4 * step, 0.0, 0.0}, step), &agent);
  EXPECT_NEAR(agent.decision().regret_allowed, 0.2 + 0.1 * 2.0, 1e-9);
  agent.setGoal(kGoal);
  test::decideIn(situationAt({2.0, 0.0, 0.0}, 20.0), &agent);
  EXPECT_NEAR(agent.decision().regret_allowed, 0.2, 1e-9) << "since the goal was set";
}

TEST(NetworkUnderBound, WithoutAnyAllowanceOnlyTheDirectionOfThePathIsLeft) {
  NavigationAgent agent = agentPreferring(kPrefersLeft, {0.0, 0.0});
  EXPECT_EQ(test::decideIn(situationAt({}), &agent).overruled, Overruled::kByBound);
  agent.setGoal(kGoal);
  EXPECT_EQ(test::decideIn(situationAt({0.0, 0.0, -M_PI_2}, 1.0), &agent).choice, Leader::kNetwork)
      << "the path leads to the left";
}

TEST(NetworkUnderBound, ADeadEndThatIsKnownIsOverruled) {
  NavigationAgent agent = agentPreferring(kPrefersStraight, {0.1, 0.0});
  const Decision& decision = test::decideIn(returnsAt(kWall, {1.2, 1.0, 0.0}), &agent);
  EXPECT_EQ(decision.overruled, Overruled::kByBound) << "towards the wall, and back again";
  EXPECT_EQ(decision.choice, Leader::kRoute);
}

TEST(NetworkUnderBound, WhatWasPassedIsRemembered) {
  NavigationAgent agent = agentPreferring(kPrefersStraight);
  test::decideIn(returnsAt(kWall), &agent);
  test::decideIn(returnsAt({}, {0.4, 0.0, 0.0}), &agent);
  double length = distanceBetween(Point2{0.4, 0.0}, agent.decision().waypoint);
  Point2 last = agent.decision().waypoint;
  for (const Point2& point : agent.decision().path_on) {
    length += distanceBetween(last, point);
    last = point;
  }
  EXPECT_GT(length, std::hypot(1.6, 1.0) + std::hypot(2.0, 1.0)) << "round the wall that it saw at first";
}

TEST(NetworkUnderBound, ItSaysWhenTheShieldTakesAwayWhatTheNetworkPrefers) {
  NavigationAgent agent = agentPreferring({0.0f, 1.0f, 3.0f, 2.0f, 0.0f});
  EXPECT_EQ(test::decideIn(situationAt({}), &agent).overruled, Overruled::kNo);
  agent.setGoal(kGoal);
  const Decision& blocked = test::decideIn(situationAt({}, 1.0, test::wall({0.3, -0.4}, {0.3, 0.4})), &agent);
  EXPECT_EQ(blocked.preferred, kStraight);
  EXPECT_NE(blocked.action, kStraight);
  EXPECT_EQ(blocked.overruled, Overruled::kByShield);
}

TEST(NetworkUnderBound, ARobotThatIsHeldUpIsLedAnotherWay) {
  NavigationAgent agent = agentPreferring(kPrefersStraight);
  ASSERT_NEAR(test::decideIn(situationAt({}), &agent).direction, 0.0, 1e-9);
  const Decision& decision = test::decideIn(situationAt({}, 2.1), &agent);
  EXPECT_GT(std::abs(decision.direction), 0.3) << "round a place 0.3 m ahead";
}

}  // namespace
}  // namespace lstm_planner::test_network_under_bound
