#include <gtest/gtest.h>

#include "lstm_planner/drive/motion/idle_watch.hpp"

namespace lstm_planner::test_idle_watch {
namespace {

class IdleWatchTest : public ::testing::Test {
 protected:
  /// What the watch says after `seconds` in which the robot gets this command and moves at this speed.
  double idleAfter(double seconds, const Twist2& command, double speed = 0.0) {
    constexpr double kPeriod = 0.05;  // s
    for (double passed = 0.0; passed < seconds; passed += kPeriod) {
      time_ += kPeriod;
      pose_.x += speed * kPeriod;
      watch_.note(pose_, time_, command);
    }
    return watch_.idle();
  }

  IdleWatch watch_;
  Pose2 pose_{1.0, 2.0, 3.0};
  double time_ = 100.0;
};

TEST_F(IdleWatchTest, ARobotThatDoesNothingOfWhatItIsToldIsNoticed) {
  EXPECT_EQ(idleAfter(2.5, {0.1, 0.0}), 0.0) << "a base takes a moment to start";
  EXPECT_NEAR(idleAfter(2.5, {0.0, -1.0}), 5.0, 0.1) << "whatever it is told";
  EXPECT_NEAR(idleAfter(9.0, {0.0, 0.0}), 5.0, 0.1) << "it was not told any more";
  EXPECT_EQ(idleAfter(0.5, {0.1, 0.0}, 0.1), 0.0);
}

TEST_F(IdleWatchTest, ARobotThatStandsOrDrivesAsItIsToldIsNotIdle) {
  EXPECT_EQ(idleAfter(20.0, {0.0, 0.0}), 0.0);
  EXPECT_EQ(idleAfter(20.0, {0.01, 0.1}), 0.0) << "less than makes any motor turn";
  EXPECT_EQ(idleAfter(20.0, {0.05, 0.0}, 0.02), 0.0) << "half as fast is driven";
}

TEST_F(IdleWatchTest, APauseOrAClockThatIsSetBackIsNoTimeInWhichItWasTold) {
  idleAfter(1.0, {0.1, 0.0});
  time_ += 60.0;
  EXPECT_EQ(idleAfter(1.0, {0.1, 0.0}), 0.0);
  time_ -= 60.0;
  EXPECT_EQ(idleAfter(0.3, {0.1, 0.0}), 0.0);
}

}  // namespace
}  // namespace lstm_planner::test_idle_watch
