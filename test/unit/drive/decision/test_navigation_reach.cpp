#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/drive/perception/reach.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/perception/scan_builder.hpp"

namespace lstm_planner::test_navigation_reach {
namespace {

std::string complaintOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

class NavigationReach : public ::testing::Test {
 protected:
  NavigationReach() : agent_(test::straightAheadPolicy(), test::routeLed(), ScanRules()) {}

  void standAt(const Pose2& pose) { agent_.perceive(makeHokuyoScan(5.0f), {}, pose, time_ += 1.0); }

  NavigationAgent agent_;
  double time_ = 0.0;
};

TEST_F(NavigationReach, RefusesAGoalThatIsTooFarAway) {
  standAt({});
  const Point2 goal{4.5e6, 0.0};
  const std::string sentence =
      "the goal is 4.5e+06 m from the robot, expected at most 10000 m: is it given in the right frame?";
  EXPECT_EQ(complaintOf([&] { agent_.drive(goal, true, 0); }), sentence);
  EXPECT_EQ(complaintOf([&] { agent_.preview(goal); }), sentence);
  EXPECT_NE(complaintOf([&] { agent_.drive({std::numeric_limits<double>::quiet_NaN(), 0.0}, true, 0); }), "");
}

TEST_F(NavigationReach, TakesAGoalThatWasTooFarAwayForNewWhenItCanBeDrivenTo) {
  standAt({});
  EXPECT_NE(complaintOf([&] { agent_.drive({kFarthestGoal + 1.0, 0.0}, true, 0); }), "");
  standAt({2.0, 0.0, 0.0});
  EXPECT_EQ(agent_.drive({kFarthestGoal + 1.0, 0.0}, false, 0), NavigationAgent::Fresh::kNewGoal);
  EXPECT_EQ(agent_.drive({kFarthestGoal + 1.0, 0.0}, false, 0), NavigationAgent::Fresh::kNo);
}

TEST_F(NavigationReach, RefusesAPoseThatIsTooFarAway) {
  EXPECT_EQ(complaintOf([&] {
              standAt({0.0, -2e7, 0.5});
            }),
            "the robot's pose in the odometry frame is (0, -2e+07) m with yaw 0.5, expected at most 1e+07 m from the "
            "origin along each axis");
}

TEST_F(NavigationReach, DecidesAmongUtmCoordinatesAsAtTheOrigin) {
  const Point2 shift{691608.0, 5334762.0};
  NavigationAgent at_origin(test::straightAheadPolicy(), test::routeLed(), ScanRules());
  for (int step = 0; step < 20; ++step) {
    const Pose2 pose{0.2 * step, 0.1, 0.3};
    at_origin.perceive(makeHokuyoScan(3.0f), {}, pose, step);
    at_origin.drive({8.0, 5.0}, step == 0, 0);
    agent_.perceive(makeHokuyoScan(3.0f), {}, {shift.x + pose.x, shift.y + pose.y, pose.yaw}, step);
    agent_.drive({shift.x + 8.0, shift.y + 5.0}, step == 0, 0);
    ASSERT_EQ(agent_.decision().choice, at_origin.decision().choice) << step;
    ASSERT_NEAR(agent_.decision().direction, at_origin.decision().direction, 1e-6) << step;
  }
}

}  // namespace
}  // namespace lstm_planner::test_navigation_reach
