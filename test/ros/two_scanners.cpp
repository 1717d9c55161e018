// Both plugins drive the simulated robot with a scanner in front and one at the back, and stand when one of them falls
// silent.

#include <diagnostic_msgs/DiagnosticArray.h>

#include <string>
#include <vector>

#include "ros/fixtures/closed_loop_fixture.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::two_scanners {
namespace {

using State = actionlib::SimpleClientGoalState;

/// In the room that the robot starts in, at (1.5, 2.5), on both sides of it (map frame).
const std::vector<Pose2> kPlaces{{1.5, 4.0, 0.0}, {1.5, 1.2, 0.0}};

class TwoScannersTest : public ClosedLoopTest {
 protected:
  void TearDown() override {
    pauseScan(false, "second_scan");
    ClosedLoopTest::TearDown();
  }

  /// A goal that is not where the robot is.
  void sendElsewhere() { send("map", distanceBetween(pose(), kPlaces[0]) > 1.0 ? kPlaces[0] : kPlaces[1]); }
};

TEST_F(TwoScannersTest, ARobotThatLosesTheOneBehindStandsSaysWhichAndGoesOn) {
  sendElsewhere();
  ASSERT_TRUE(eventuallyDrives());
  ASSERT_TRUE(pauseScan(true, "second_scan"));
  // Three periods of 0.1 s, the controller's 0.05 s, and up to 1 s to brake from 2 m/s.
  EXPECT_LE(secondsUntilStill(), 1.5);
  EXPECT_TRUE(log_.eventuallyHas("the robot stands: the newest message on /second_scan is * s old"));
  EXPECT_TRUE(log_.eventuallyHas("no plan: the newest message on /second_scan is * s old"));
  EXPECT_EQ(log_.count("the newest message on /scan is"), 0) << "the other one is well";
  const Pose2 stands = pose();
  ros::Duration(2.0).sleep();
  EXPECT_LT(distanceBetween(pose(), stands), 0.01);

  ASSERT_TRUE(pauseScan(false, "second_scan"));
  ASSERT_TRUE(over(60.0));
  EXPECT_EQ(client_.getState(), State::SUCCEEDED) << client_.getState().getText();
}

TEST_F(TwoScannersTest, ARobotThatLosesTheOneInFrontStands) {
  sendElsewhere();
  ASSERT_TRUE(eventuallyDrives());
  ASSERT_TRUE(pauseScan(true));
  EXPECT_LE(secondsUntilStill(), 1.5);
  EXPECT_TRUE(log_.eventuallyHas("the robot stands: the newest message on /scan is * s old"));
}

TEST_F(TwoScannersTest, DiagnosticsTellOfBoth) {
  std::mutex mutex;
  std::string told;
  CallbackThread callbacks;
  const boost::function<void(const diagnostic_msgs::DiagnosticArray::ConstPtr&)> note = [&](const auto& message) {
    const std::lock_guard<std::mutex> lock(mutex);
    for (const auto& status : message->status) told += status.name + "\n";
  };
  const ros::Subscriber subscriber = callbacks.nodeHandle().subscribe("/diagnostics", 10, note);
  for (const std::string plugin : {"LstmGlobalPlanner", "SteeringController"}) {
    for (const std::string scanner : {" scan", " second scan"}) {
      EXPECT_TRUE(eventually([&] {
        const std::lock_guard<std::mutex> lock(mutex);
        return told.find("move_base: " + plugin + scanner + "\n") != std::string::npos;
      })) << plugin
          << scanner;
    }
  }
}

const RosProgram program("two_scanners", &runTestsBesideSpinner);

}  // namespace
}  // namespace lstm_planner::two_scanners
