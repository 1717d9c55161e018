#include <gtest/gtest.h>

#include <clocale>
#include <locale>
#include <string>
#include <vector>

#include "ros/panel/drive_view.hpp"

namespace lstm_planner::test_drive_view {
namespace {

Report networkDecision() {
  Report decision;
  decision.message = "network";
  decision.values = {{"leader", "network"},
                     {"goal_distance", "3.4219"},
                     {"goal_bearing", "-0.5236"},
                     {"action", "3"},
                     {"preferences", "1, 2, 5, 3, 1"},
                     {"allowed", "1, 1, 0, 1, 0"},
                     {"action_angles", "-1.5708, -0.785398, 0, 0.785398, 1.5708"}};
  return decision;
}

TEST(DriveView, SaysWhatIsMissingBeforeAnythingIsHeard) {
  const DriveView view;
  EXPECT_EQ(view.model(), "");
  EXPECT_EQ(view.leader(10.0).text, "there is no planner");
  EXPECT_EQ(view.controller().text, "there is no controller");
  EXPECT_EQ(view.goal(0.0), "");
  EXPECT_TRUE(view.actions(0.0).empty());
  EXPECT_EQ(view.removed(0.0), "");
  EXPECT_FALSE(view.hasRecorder(0.0));
  EXPECT_EQ(view.recorder(0.0).text, "nothing is recorded");
}

TEST(DriveView, ShowsTheActionsFromLeftToRight) {
  DriveView view;
  view.hearDecision(networkDecision(), 10.0);
  const std::vector<ViewAction> actions = view.actions(10.5);
  ASSERT_EQ(actions.size(), 5u);
  std::vector<std::string> names;
  for (const ViewAction& action : actions) names.push_back(action.name);
  EXPECT_EQ(names, (std::vector<std::string>{"90° left", "45° left", "ahead", "45° right", "90° right"}));
  EXPECT_DOUBLE_EQ(actions[2].share, 1.0);
  EXPECT_DOUBLE_EQ(actions[1].share, 0.5);
  EXPECT_DOUBLE_EQ(actions[0].share, 0.0);
  EXPECT_TRUE(actions[2].removed);
  EXPECT_FALSE(actions[1].removed);
  EXPECT_TRUE(actions[1].chosen);
  EXPECT_FALSE(actions[2].chosen);
}

struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST(DriveView, ReadsNumbersWhereTheLocaleHasACommaInThem) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  const std::locale streams = std::locale::global(std::locale(std::locale(), new DecimalComma));
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // of C's functions, where it is installed
  DriveView view;
  view.hearDecision(networkDecision(), 10.0);
  const std::vector<ViewAction> actions = view.actions(10.0);
  const std::string goal = view.goal(10.0);
  std::locale::global(streams);
  std::setlocale(LC_NUMERIC, before.c_str());
  ASSERT_EQ(actions.size(), 5u);
  EXPECT_EQ(actions[1].name, "45° left");
  EXPECT_NE(goal.find("30° right"), std::string::npos) << goal;
}

TEST(DriveView, NamesWhatTheShieldRemoved) {
  DriveView view;
  Report decision = networkDecision();
  view.hearDecision(decision, 10.0);
  EXPECT_EQ(view.removed(10.0), "90° left, ahead");
  decision.values["allowed"] = "1, 1, 1, 1, 1";
  view.hearDecision(decision, 10.0);
  EXPECT_EQ(view.removed(10.0), "nothing");
}

TEST(DriveView, ShowsNoActionsWhereTheNetworkDoesNotDecide) {
  DriveView view;
  Report decision = networkDecision();
  for (const char* source : {"route", "goal in sight", "look around"}) {
    decision.message = source;
    view.hearDecision(decision, 10.0);
    EXPECT_TRUE(view.actions(10.0).empty()) << source;
    EXPECT_EQ(view.removed(10.0), "the network is not asked") << source;
    EXPECT_EQ(view.goal(10.0), "3.42 m, 30° right") << source;
  }
}

TEST(DriveView, ShowsTheActionsOfANetworkThatTheBoundOverruled) {
  DriveView view;
  Report decision = networkDecision();
  decision.message = "route";
  decision.values["overruled"] = "by the bound";
  decision.values["what"] = "the remembered path decided: the leader's detour would exceed the bound";
  view.hearDecision(decision, 10.0);
  EXPECT_EQ(view.actions(10.0).size(), 5u);
  EXPECT_EQ(view.decided(10.0), decision.values["what"]);
  EXPECT_EQ(view.decided(13.0), "");
}

TEST(DriveView, ShowsNoActionsOfADecisionThatDoesNotNameThem) {
  DriveView view;
  for (const char* key : {"preferences", "allowed", "action_angles"}) {
    Report decision = networkDecision();
    decision.values.erase(key);
    view.hearDecision(decision, 10.0);
    EXPECT_TRUE(view.actions(10.0).empty()) << key;
  }
}

TEST(DriveView, ForgetsADecisionThatIsOld) {
  DriveView view;
  view.hearDecision(networkDecision(), 10.0);
  EXPECT_NE(view.goal(11.9), "");
  EXPECT_EQ(view.goal(12.1), "");
  EXPECT_TRUE(view.actions(12.1).empty());
}

TEST(DriveView, SaysWhoLeadsAndWhyTheRobotStands) {
  DriveView view;
  view.setPlanner(Report{0, "the route leads: it is chosen", {{"model", "/a/folder/own.onnx"}}});
  EXPECT_EQ(view.leader(10.0).text, "the route leads: it is chosen");
  EXPECT_EQ(view.model(), "own.onnx");
  view.setPlanner(Report{1, "no plan", {{"why", "no scan has been received on /scan"}}});
  EXPECT_EQ(view.leader(10.0).text, "no plan: no scan has been received on /scan");
  EXPECT_EQ(view.leader(10.0).level, 1);
  view.setController(Report{1, "the robot stands: there is no plan to follow", {}});
  EXPECT_EQ(view.controller().text, "the robot stands: there is no plan to follow");
  view.setController({});
  EXPECT_EQ(view.controller().text, "there is no controller");
}

TEST(DriveView, TakesTheLeaderFromTheDecisionWhereNoStatusIsPublished) {
  DriveView view;
  Report decision = networkDecision();
  decision.values["why"] = "it is chosen";
  view.hearDecision(decision, 10.0);
  EXPECT_EQ(view.leader(10.5).text, "the network leads: it is chosen");
  EXPECT_EQ(view.leader(12.5).text, "there is no planner");
}

TEST(DriveView, SaysHowTheRecordingGoes) {
  DriveView view;
  view.hearRecorder({0, "recording", {{"steps", "12"}, {"episodes", "2"}, {"paused", "no"}}}, 10.0);
  EXPECT_TRUE(view.hasRecorder(11.0));
  EXPECT_FALSE(view.isPaused());
  EXPECT_EQ(view.recorder(11.0).text, "recording (steps: 12, episodes: 2)");
  view.hearRecorder({0, "paused", {{"steps", "12"}, {"episodes", "2"}, {"paused", "yes"}}}, 11.0);
  EXPECT_TRUE(view.isPaused());
  EXPECT_FALSE(view.hasRecorder(14.1));
}

}  // namespace
}  // namespace lstm_planner::test_drive_view
