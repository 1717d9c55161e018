// The stub's own clock waits for a controller that is at work (parameter command_period, here 0.06 s).
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>

#include "ros/fixtures/ros_program.hpp"
#include "ros/fixtures/waiting.hpp"

namespace lstm_planner::create2_stub_waits {
namespace {

constexpr double kDeadline = 30.0;  // s of the computer's clock after which a test has failed
constexpr double kPeriod = 0.06;    // s, simulated, as in the .test file

class Create2StubWaits : public ::testing::Test {
 protected:
  void SetUp() override {
    clock_ = node_.subscribe("/clock", 100, &Create2StubWaits::onClock, this);
    commands_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    ASSERT_TRUE(eventually([this] { return now_ > 0.0 && commands_.getNumSubscribers() > 0; }, kDeadline, spinBriefly));
  }

  void onClock(const rosgraph_msgs::Clock::ConstPtr& message) { now_ = message->clock.toSec(); }

  void command(double speed) {
    geometry_msgs::Twist message;
    message.linear.x = speed;
    commands_.publish(message);
  }

  /// Simulated seconds that pass while the computer's clock goes on by `seconds`.
  double passIn(double seconds) {
    const double begin = now_;
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
    while (ros::WallTime::now() < end) spinBriefly();
    return now_ - begin;
  }

  ros::NodeHandle node_;
  ros::Subscriber clock_;
  ros::Publisher commands_;
  double now_ = 0.0;  ///< s, simulated
};

TEST_F(Create2StubWaits, ForTheNextCommandWhileTheRobotIsToldToMove) {
  constexpr int kCommands = 50;
  constexpr double kThought =
      0.02;  // s of the computer's clock from one to the next: 0.2 s pass if the stub does not wait
  command(0.1);
  ASSERT_TRUE(eventually([&] { return passIn(kThought) == 0.0; }, kDeadline, spinBriefly));
  const double begin = now_;
  for (int i = 0; i < kCommands; ++i) {
    const double before = now_;
    command(0.1);
    ASSERT_TRUE(eventually([&] { return now_ > before; }, kDeadline, spinBriefly));
    passIn(kThought);
  }
  // A command that comes late adds nothing; how fast the computer is does not matter.
  EXPECT_LE(now_ - begin, (kCommands + 1) * kPeriod + 1e-6);
  EXPECT_GT(now_ - begin, 0.0);
}

TEST_F(Create2StubWaits, NotForEver) {
  command(0.1);
  const double begin = now_;
  EXPECT_TRUE(eventually([&] { return now_ > begin + 20.0 * kPeriod; }, kDeadline, spinBriefly));
}

TEST_F(Create2StubWaits, NotForOneThatLetsTheRobotStand) {
  command(0.0);
  const double begin = now_;
  EXPECT_TRUE(eventually([&] { return now_ > begin + 50.0 * kPeriod; }, kDeadline, spinBriefly));
}

const RosProgram program("create2_stub_waits", &runTests);

}  // namespace
}  // namespace lstm_planner::create2_stub_waits
