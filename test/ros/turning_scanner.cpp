// move_base with both plugins and the simulated RPLIDAR, which measures its beams one after the other and lists them
// backwards: the robot finds that out, and people who are not there do not hold it up.

#include "ros/fixtures/closed_loop_fixture.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::turning_scanner {
namespace {

using State = actionlib::SimpleClientGoalState;

const Pose2 kLibrary{6.5, 8.25, 1.57};  // of config/demo_goals.yaml, two rooms away

class TurningScannerTest : public ClosedLoopTest {};

TEST_F(TurningScannerTest, FindsOutWhenTheBeamsAreMeasured) {
  send("map", kLibrary);
  ASSERT_TRUE(over(300.0));
  EXPECT_EQ(client_.getState(), State::SUCCEEDED) << client_.getState().getText();
  EXPECT_GT(log_.count("by comparison of scans on /scan their first beam is measured 0.18* s after the stamp, the last "
                       "one 0.000 s: from now on scans are corrected"),
            0);
}

const RosProgram program("turning_scanner", &runTestsBesideSpinner);

}  // namespace
}  // namespace lstm_planner::turning_scanner
