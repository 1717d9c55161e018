#include <gtest/gtest.h>

#include <limits>

#include "lstm_planner/drive/decision/decision_text.hpp"

namespace lstm_planner::test_decision_text {
namespace {

Decision decisionBy(Decision::Choice choice, Overruled overruled = Overruled::kNo) {
  Decision decision;
  decision.choice = choice;
  decision.overruled = overruled;
  return decision;
}

TEST(DecisionText, SaysWhetherTheNetworkIsOnTheRememberedPath) {
  Decision decision = decisionBy(Leader::kNetwork);
  decision.on_route = true;
  EXPECT_EQ(describe(decision), "the network decided, along the remembered path");
  decision.on_route = false;
  decision.regret = 0.25;
  EXPECT_EQ(describe(decision), "the network decided, a detour of 0.25 m");
}

TEST(DecisionText, SaysWhoOverruledTheNetwork) {
  EXPECT_EQ(describe(decisionBy(Leader::kNetwork, Overruled::kByShield)),
            "the network decided; the shield removed what it preferred");
  Decision bounded = decisionBy(Leader::kRoute, Overruled::kByBound);
  bounded.regret = 0.8;
  bounded.regret_used = 0.3;
  bounded.regret_allowed = 0.5;
  EXPECT_EQ(
      describe(bounded),
      "the remembered path decided: the leader's detour of 0.80 m would exceed the bound (0.30 m of 0.50 m used)");
  bounded.regret = std::numeric_limits<double>::infinity();
  EXPECT_EQ(describe(bounded), "the remembered path decided: no path leads on from where the leader would go");
  EXPECT_EQ(describe(decisionBy(Leader::kRoute, Overruled::kByShield)),
            "the remembered path decided: the shield removed all steering angles");
}

}  // namespace
}  // namespace lstm_planner::test_decision_text
