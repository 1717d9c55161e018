// move_base (or standalone_move_base) with both plugins drives the simulated robot, seen from outside.

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/GetPlan.h>
#include <std_srvs/Trigger.h>

#include <cmath>
#include <string>

#include "ros/fixtures/closed_loop_fixture.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::closed_loop {
namespace {

using State = actionlib::SimpleClientGoalState;

/// Both in the room that the robot starts in, at (1.5, 2.5): the second one behind the box. How far a policy gets by
/// itself is not asked here (map frame).
const Pose2 kNear{1.5, 4.0, 0.0};
const Pose2 kBehindTheBox{3.6, 4.1, 0.0};

/// standalone_move_base says so itself, move_base leaves it to the planner.
void expectMoonIsUnknown(LogListener* log, const std::string& whose) {
  EXPECT_TRUE(eventually([&] {
    return log->count(whose + "the goal's frame 'moon' is not connected to 'odom' by tf") > 0 ||
           log->count("no plan: no transform from moon to odom") > 0;
  }));
}

TEST_F(ClosedLoopTest, ArrivesAtAGoalInAnotherFrameWithoutContact) {
  send("map", kBehindTheBox);
  ASSERT_TRUE(over(120.0));
  EXPECT_EQ(client_.getState(), State::SUCCEEDED) << client_.getState().getText();
  // position_tolerance is 0.2 m; the odometry's ticks and braking add less than 0.1 m.
  EXPECT_LT(distanceBetween(pose(), kBehindTheBox), 0.3);
}

TEST_F(ClosedLoopTest, StandsAfterCancelAndTakesTheSameGoalAgain) {
  send("map", kNear);
  ASSERT_TRUE(eventuallyDrives());
  client_.cancelGoal();
  ASSERT_TRUE(over(5.0));
  EXPECT_EQ(client_.getState(), State::PREEMPTED);
  EXPECT_LT(secondsUntilStill(), 0.5);
  send("map", kNear);
  ASSERT_TRUE(eventuallyDrives());
}

TEST_F(ClosedLoopTest, StandsStillWithinHalfASecondWhenTheScanStopsAndGoesOnWhenItReturns) {
  send("map", kNear);
  ASSERT_TRUE(eventuallyDrives());
  ASSERT_TRUE(pauseScan(true));
  EXPECT_LE(secondsUntilStill(), 0.5);
  ros::Duration(2.0).sleep();
  EXPECT_LT(speed(), 0.01) << "still without a scan";
  ASSERT_TRUE(pauseScan(false));
  EXPECT_TRUE(eventuallyDrives());
}

TEST_F(ClosedLoopTest, TakesAGoalFromRvizsTopic) {
  ros::NodeHandle node_handle;
  ros::Publisher goals = node_handle.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1);
  ASSERT_TRUE(eventually([&] { return goals.getNumSubscribers() > 0; }));
  const Pose2 before = pose();
  goals.publish(toMessage(distanceBetween(before, kNear) > 0.5 ? kNear : kBehindTheBox, "map"));
  EXPECT_TRUE(eventuallyDrives());
  EXPECT_TRUE(eventually([&] { return distanceBetween(before, pose()) > 0.2; }));
}

TEST_F(ClosedLoopTest, MakePlanAnswersWithoutDriving) {
  secondsUntilStill();
  const Pose2 before = pose();
  nav_msgs::GetPlan service;
  service.request.goal = toMessage({before.x + 3.0, before.y + 4.0, 0.0}, "map");
  // It is not served before the goal of the test before is over.
  ASSERT_TRUE(eventually([&] { return ros::service::call("move_base/make_plan", service); }));
  const auto& poses = service.response.plan.poses;
  ASSERT_GT(poses.size(), 2u);
  // The robot starts in the middle of the odometry frame, turned: lengths are the same in both.
  const auto& first = poses.front().pose.position;
  const auto& last = poses.back().pose.position;
  EXPECT_EQ(poses.front().header.frame_id, "odom");
  EXPECT_NEAR(std::hypot(last.x - first.x, last.y - first.y), 5.0, 0.1);
  EXPECT_LT(distanceBetween(before, pose()), 0.01);

  service.request.goal.header.frame_id = "moon";
  service.response = {};
  EXPECT_TRUE(!ros::service::call("move_base/make_plan", service) || service.response.plan.poses.empty());
  expectMoonIsUnknown(&log_, "make_plan: ");
}

TEST_F(ClosedLoopTest, GoalInsideAnObstacleIsAbortedWithoutContact) {
  send("map", {2.85, 3.43, 0.0});  // inside the box of 0.7 m x 0.55 m in the room where the robot starts
  ASSERT_TRUE(over(250.0));
  EXPECT_EQ(client_.getState(), State::ABORTED);
  EXPECT_TRUE(log_.eventuallyHas("the goal seems to lie in or behind an obstacle: it is * m away, and no path"));
  EXPECT_TRUE(log_.eventuallyHas("no plan: there is no path to the goal")) << client_.getState().getText();
}

TEST_F(ClosedLoopTest, GoalInAFrameThatIsNotThereMovesNothing) {
  const Pose2 before = pose();
  send("moon", kNear);
  over(5.0);  // standalone_move_base aborts at once; move_base tries for ever, and takes a cancel
  expectMoonIsUnknown(&log_, "The goal was refused: ");
  EXPECT_LT(distanceBetween(before, pose()), 0.01);
  client_.cancelGoal();
  ASSERT_TRUE(over(5.0));
  EXPECT_TRUE(client_.getState() == State::ABORTED || client_.getState() == State::PREEMPTED);
}

// The last test: from the jump on, the odometry is no longer where the map's frame says.
TEST_F(ClosedLoopTest, OdometryJumpIsSurvivedWithoutContact) {
  send("odom", {3.0, 0.0, 0.0});
  ASSERT_TRUE(eventuallyDrives());
  std_srvs::Trigger jump;
  ASSERT_TRUE(ros::service::call("create2_stub/jump_odometry", jump));
  const Pose2 before = pose();
  EXPECT_TRUE(eventually([&] { return distanceBetween(before, pose()) > 0.2; })) << "it goes on";
  over(10.0);
}

const RosProgram program("closed_loop", &runTestsBesideSpinner);

}  // namespace
}  // namespace lstm_planner::closed_loop
