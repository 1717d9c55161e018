// move_base with both plugins drives in the map frame, in which a localisation corrects bad odometry by jumps.

#include <tf2_msgs/TFMessage.h>

#include <atomic>

#include "ros/fixtures/closed_loop_fixture.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::localised {
namespace {

using State = actionlib::SimpleClientGoalState;

const Pose2 kArchive{2.0, 8.25, 1.57};  // of config/demo_goals.yaml
const Pose2 kLibrary{6.5, 8.25, 1.57};
constexpr double kJump = 0.3;               // m, localisation_jump in the test file
constexpr double kPositionTolerance = 0.2;  // m, of the controller
constexpr double kBraking = 0.1;            // m, that ticks and braking add

class LocalisedTest : public ClosedLoopTest {
 protected:
  /// How often map -> odom has changed so far.
  int corrections() const { return corrections_; }

 private:
  void onTransforms(const tf2_msgs::TFMessage::ConstPtr& message) {
    for (const geometry_msgs::TransformStamped& transform : message->transforms) {
      if (transform.header.frame_id != "map") continue;
      const double x = transform.transform.translation.x;
      if (x != x_) ++corrections_;
      x_ = x;
    }
  }

  double x_ = 1.5;  ///< m, of the start in config/demo_goals.yaml
  std::atomic<int> corrections_{0};
  CallbackThread callbacks_;
  ros::Subscriber transforms_ = callbacks_.nodeHandle().subscribe("/tf", 100, &LocalisedTest::onTransforms, this);
};

TEST_F(LocalisedTest, ArrivesWhereTheGoalTrulyIsAndForgetsNothing) {
  for (const Pose2& goal : {kArchive, kLibrary, kArchive}) {
    send("map", goal);
    ASSERT_TRUE(over(300.0));
    EXPECT_EQ(client_.getState(), State::SUCCEEDED) << client_.getState().getText();
    EXPECT_LT(distanceBetween(pose(), goal), kPositionTolerance + kJump + kBraking);
  }
  EXPECT_GE(corrections(), 2);
  log_.flush();
  EXPECT_EQ(log_.count("forgotten"), 0) << "a correction is no jump";
}

const RosProgram program("localised", &runTestsBesideSpinner);

}  // namespace
}  // namespace lstm_planner::localised
