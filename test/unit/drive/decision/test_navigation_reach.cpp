#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "lstm_planner/drive/decision/goal_changes.hpp"
#include "lstm_planner/drive/perception/reach.hpp"
#include "support/agent_steps.hpp"
#include "support/refusal.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/perception/scan_builder.hpp"

namespace lstm_planner::test_navigation_reach {
namespace {

using test::refusalOf;

class NavigationReach : public ::testing::Test {
 protected:
  NavigationReach() : agent_(test::straightAheadPolicy(), test::routeLed()) {}

  void standAt(const Pose2& pose) { test::perceive(&agent_, makeHokuyoScan(5.0f), {}, pose, time_ += 1.0); }

  GoalChanges::Fresh tell(const Pose2& goal, bool is_new) { return changes_.tell(&agent_, goal, {}, is_new, 0); }

  NavigationAgent agent_;
  GoalChanges changes_;
  double time_ = 0.0;
};

TEST_F(NavigationReach, RefusesAGoalThatIsTooFarAway) {
  standAt({});
  const Point2 goal{4.5e6, 0.0};
  const std::string sentence =
      "the goal is 4.5e+06 m from the robot, expected at most 10000 m: is it given in the right frame?";
  EXPECT_EQ(refusalOf([&] { tell({goal.x, goal.y}, true); }), sentence);
  EXPECT_EQ(refusalOf([&] { agent_.preview(goal); }), sentence);
  const std::string nowhere =
      "the goal is nan m from the robot, expected at most 10000 m: is it given in the right frame?";
  EXPECT_EQ(refusalOf([&] { tell({std::numeric_limits<double>::quiet_NaN(), 0.0}, true); }), nowhere);
  agent_.setGoal(goal);
  EXPECT_EQ(refusalOf([&] { agent_.decide(); }), sentence);
  agent_.setGoal({std::numeric_limits<double>::quiet_NaN(), 0.0});
  EXPECT_EQ(refusalOf([&] { agent_.decide(); }), nowhere);
}

TEST_F(NavigationReach, TakesAGoalThatWasTooFarAwayForNewWhenItCanBeDrivenTo) {
  standAt({});
  EXPECT_EQ(refusalOf([&] {
              tell({kFarthestGoal + 1.0, 0.0}, true);
            }),
            "the goal is 10001 m from the robot, expected at most 10000 m: is it given in the right frame?");
  standAt({2.0, 0.0, 0.0});
  EXPECT_EQ(tell({kFarthestGoal + 1.0, 0.0}, false), GoalChanges::Fresh::kNewGoal);
  EXPECT_EQ(tell({kFarthestGoal + 1.0, 0.0}, false), GoalChanges::Fresh::kNo);
}

TEST_F(NavigationReach, RefusesAPoseThatIsTooFarAway) {
  EXPECT_EQ(refusalOf([&] {
              standAt({0.0, -2e7, 0.5});
            }),
            "the robot's pose in the odometry frame is (0, -2e+07) m with yaw 0.5, expected at most 1e+07 m from the "
            "origin along each axis");
}

TEST_F(NavigationReach, DecidesAmongUtmCoordinatesAsAtTheOrigin) {
  const Point2 shift{691608.0, 5334762.0};
  NavigationAgent at_origin(test::straightAheadPolicy(), test::routeLed());
  for (int step = 0; step < 20; ++step) {
    const Pose2 pose{0.2 * step, 0.1, 0.3};
    test::perceive(&at_origin, makeHokuyoScan(3.0f), {}, pose, step);
    if (step == 0) at_origin.setGoal({8.0, 5.0});
    at_origin.decide();
    test::perceive(&agent_, makeHokuyoScan(3.0f), {}, {shift.x + pose.x, shift.y + pose.y, pose.yaw}, step);
    if (step == 0) agent_.setGoal({shift.x + 8.0, shift.y + 5.0});
    agent_.decide();
    ASSERT_EQ(agent_.decision().choice, at_origin.decision().choice) << step;
    ASSERT_NEAR(agent_.decision().direction, at_origin.decision().direction, 1e-6) << step;
  }
}

}  // namespace
}  // namespace lstm_planner::test_navigation_reach
