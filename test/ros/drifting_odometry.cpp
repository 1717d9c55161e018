// move_base with both plugins drives by odometry that is wrong by 10 %: the goal stays where it was given.

#include <nav_msgs/Odometry.h>

#include <mutex>

#include "ros/fixtures/closed_loop_fixture.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::drifting_odometry {
namespace {

using State = actionlib::SimpleClientGoalState;

const Pose2 kLibrary{6.5, 8.25, 1.57};      // of config/demo_goals.yaml, two rooms away
constexpr double kPositionTolerance = 0.2;  // m, of the controller
constexpr double kBraking = 0.1;            // m, that ticks and braking add

class DriftingOdometryTest : public ClosedLoopTest {
 protected:
  /// The robot where odometry says that it is, in the map frame as it was at the start.
  Pose2 poseByOdometry(const Pose2& start) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return compose(start, odometry_);
  }

 private:
  void onOdometry(const nav_msgs::Odometry::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    odometry_ = fromMessage(message->pose.pose);
  }

  std::mutex mutex_;
  Pose2 odometry_;
  CallbackThread callbacks_;
  ros::Subscriber odom_ = callbacks_.nodeHandle().subscribe("odom", 10, &DriftingOdometryTest::onOdometry, this);
};

TEST_F(DriftingOdometryTest, ArrivesWhereTheGoalWasWhenItWasGiven) {
  const Pose2 start = pose();
  send("map", kLibrary);
  ASSERT_TRUE(over(300.0));
  EXPECT_EQ(client_.getState(), State::SUCCEEDED) << client_.getState().getText();
  EXPECT_EQ(client_.getState().getText(), "Goal reached.") << "the plan's end moved in odom, and lies at the goal";
  EXPECT_LT(distanceBetween(pose(), kLibrary), kPositionTolerance + kBraking);
  EXPECT_GT(distanceBetween(poseByOdometry(start), pose()), kPositionTolerance + kBraking)
      << "else odometry alone would do";
}

const RosProgram program("drifting_odometry", &runTestsBesideSpinner);

}  // namespace
}  // namespace lstm_planner::drifting_odometry
