// Goals that take each other's place, as from a program that follows somebody: standalone_move_base drives on.

#include <ros/package.h>

#include <cmath>

#include "ros/fixtures/closed_loop_fixture.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::replaced_goals {
namespace {

constexpr double kDrive = 6.0;  // s

class ReplacedGoalsTest : public ClosedLoopTest {
 protected:
  void SetUp() override {
    if (!ros::package::getPath("nav_core").empty()) {
      GTEST_SKIP() << "standalone_move_base is not built where there is a navigation stack";
    }
    ClosedLoopTest::SetUp();
    sendAhead();
    ASSERT_TRUE(eventually([&] { return speed() > 0.25; }));
  }

  /// Somewhere ahead in the open field, each time a little to the other side.
  void sendAhead() {
    side_ = -side_;
    send("map", {pose().x + 10.0, start_.y + side_, 0.0});
  }

  /// m/s, while goals come at `rate` (Hz).
  double meanSpeed(double rate) {
    const Pose2 before = pose();
    const ros::Time begin = ros::Time::now();
    for (int i = 0; i < std::lround(kDrive * rate); ++i) {
      ros::Duration(1.0 / rate).sleep();
      sendAhead();
    }
    return distanceBetween(before, pose()) / (ros::Time::now() - begin).toSec();
  }

  const Pose2 start_{0.0, 50.0, 0.0};
  double side_ = 0.1;
};

TEST_F(ReplacedGoalsTest, TheRobotIsAsFastAsWithOneGoal) {
  const Pose2 before = pose();
  const ros::Time begin = ros::Time::now();
  ros::Duration(kDrive).sleep();
  const double with_one_goal = distanceBetween(before, pose()) / (ros::Time::now() - begin).toSec();
  EXPECT_GT(with_one_goal, 0.25) << "max_linear is 0.3 m/s";
  for (const double rate : {1.0, 5.0, 10.0, 20.0}) {
    EXPECT_GE(meanSpeed(rate), 0.95 * with_one_goal) << rate << " goals a second";
  }
}

TEST_F(ReplacedGoalsTest, TheRobotStandsWhereThereIsNoPlanToTheNewGoal) {
  send("map", {2e4, start_.y, 0.0});
  EXPECT_LE(secondsUntilStill(), 0.5);
  EXPECT_TRUE(log_.eventuallyHas("no plan: "));
  sendAhead();
  EXPECT_TRUE(eventuallyDrives());
}

const RosProgram program("replaced_goals", &runTestsBesideSpinner);

}  // namespace
}  // namespace lstm_planner::replaced_goals
