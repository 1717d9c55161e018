// What a network needs of scanner and parameters, and who leads where it does not get it.

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "support/agent_steps.hpp"
#include "support/refusal.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/perception/scan_builder.hpp"

namespace lstm_planner::test_scanner_reach {
namespace {

AgentParameters networkLed() {
  AgentParameters parameters;
  parameters.leader = Leader::kNetwork;
  return parameters;
}

/// Prefers to turn left wherever it may.
DrivePolicy leftwards() { return test::policyPreferring({0.0f, 1.0f, 2.0f, 3.0f, 4.0f}); }

/// A robot whose driver sends that as range_max from time to time. The model needs 3 m: half its range cap.
class ScannerReach : public ::testing::Test {
 protected:
  Decision step(double range_max) {
    LaserScan scan = makeHokuyoScan(1.9f);
    scan.range_max = range_max;
    test::perceive(&agent_, scan, {}, {0.45 * steps_, 0.0, 0.0}, 0.5 * steps_);
    if (steps_++ == 0) agent_.setGoal({20.0, 0.0});
    return agent_.decide();
  }

  NavigationAgent agent_{leftwards(), networkLed()};
  int steps_ = 0;
};

TEST_F(ScannerReach, TheRememberedPathLeadsWhereTheScannerIsTooShortForTheNetwork) {
  const Decision& decision = step(2.77);
  EXPECT_EQ(decision.leader, Leader::kRoute);
  EXPECT_TRUE(decision.on_route);
  EXPECT_EQ(decision.preferred, -1) << "the network is not asked";
  EXPECT_EQ(agent_.standInWarning(),
            "the scanner reaches 2.77 m, the model was trained with a range cap of 6 m and needs at least "
            "half of it: the path through the remembered obstacles leads in its place");
}

TEST_F(ScannerReach, TheNetworkLeadsWhereItIsLongEnough) {
  EXPECT_EQ(step(3.0).leader, Leader::kNetwork);
  EXPECT_EQ(agent_.standInWarning(), "");
}

TEST_F(ScannerReach, TheLargestRangeSoFarCountsAndNotThatOfOneScan) {
  // Some drivers send the largest reading as range_max.
  for (const double range_max : {2.4, 2.77, 2.0}) EXPECT_EQ(step(range_max).leader, Leader::kRoute) << range_max;
  EXPECT_EQ(step(3.4).leader, Leader::kNetwork);
  for (const double range_max : {2.1, 2.77, 2.9}) EXPECT_EQ(step(range_max).leader, Leader::kNetwork) << range_max;
  EXPECT_EQ(agent_.standInWarning(), "");
}

TEST_F(ScannerReach, ANewGoalIsLedAsTheLastOne) {
  step(2.77);
  agent_.setGoal({20.0, 3.0});
  EXPECT_EQ(agent_.decision().leader, Leader::kRoute);
}

TEST_F(ScannerReach, OnlyANetworkThatLeadsNeedsIt) {
  AgentParameters changed = networkLed();
  changed.leader = Leader::kRoute;
  agent_.change(changed);
  EXPECT_EQ(step(2.0).leader, Leader::kRoute);
  EXPECT_EQ(agent_.standInWarning(), "") << "nobody stands in for anybody";
  changed.leader = Leader::kNetwork;
  agent_.change(changed);
  EXPECT_EQ(step(2.0).leader, Leader::kRoute);
  EXPECT_NE(agent_.standInWarning(), "");
}

TEST(ScannerReachWithoutMemory, EveryScanOfAScannerThatIsTooShortIsRefused) {
  AgentParameters forgetful = networkLed();
  forgetful.memory.enabled = false;
  NavigationAgent agent(leftwards(), forgetful);
  LaserScan scan = makeHokuyoScan(1.9f);
  scan.range_max = 2.5;
  for (int time = 0; time < 3; ++time) {
    const std::string why = test::refusalOf<std::invalid_argument>([&] { test::perceive(&agent, scan, {}, {}, time); });
    EXPECT_NE(why.find("the scanner reaches 2.5"), std::string::npos) << why;
  }
}

TEST(ScannerReachInSimulation, ARobotWithAShortScannerArrivesLedByTheRememberedPath) {
  const GridWorld world(test::emptyHall(9.0, 4.0));
  DriveParameters parameters = test::quickDrive(120.0);
  parameters.robot.scanner.range_max = 2.5;
  parameters.robot.scanner.sight = 2.5;
  NavigationAgent agent(leftwards(), networkLed());
  const DriveResult result = drive(world, {{1.0, 2.0, 0.0}, {8.0, 2.0}}, parameters, 1, &agent);
  EXPECT_EQ(result.end, DriveResult::End::kReached);
  EXPECT_EQ(result.steps_by.at(indexOf(Leader::kNetwork)), 0);
  EXPECT_NE(agent.standInWarning(), "");
}

TEST(StepLength, ConcernsOnlyAModelThatLeads) {
  AgentParameters parameters = networkLed();
  parameters.step.length = 0.5;  // the model's is 0.4
  const std::string why =
      test::refusalOf<std::invalid_argument>([&] { NavigationAgent agent(leftwards(), parameters); });
  EXPECT_NE(why.find("step/length is 0.5"), std::string::npos) << why;
  parameters.leader = Leader::kRoute;
  NavigationAgent agent(leftwards(), parameters);
  AgentParameters changed = parameters;
  changed.leader = Leader::kNetwork;
  EXPECT_NE(test::refusalOf<std::invalid_argument>([&] { agent.change(changed); }).find("step/length is 0.5"),
            std::string::npos);
  EXPECT_EQ(agent.parameters().leader, Leader::kRoute);
}

}  // namespace
}  // namespace lstm_planner::test_scanner_reach
