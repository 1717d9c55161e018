// An odometry whose twist is wrong and whose poses are right: both plugins with their shipped parameters drive at full
// speed, and the log says once what is wrong. In lock step.

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <string>

#include "lstm_planner/simulation/world.hpp"
#include "ros/fixtures/faulty_robot.hpp"
#include "ros/fixtures/log_listener.hpp"
#include "ros/fixtures/plugin_host.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::wrong_twists {
namespace {

struct Publisher {
  const char* name;
  std::function<void(nav_msgs::Odometry*)> alter;
};
std::ostream& operator<<(std::ostream& out, const Publisher& publisher) { return out << publisher.name; }

/// Mean speed (m/s) on the way round two corners of an open field, in 40 s from rest.
double meanSpeed(const std::function<void(nav_msgs::Odometry*)>& alter) {
  constexpr double kDrive = 40.0;
  const CircleWorld nothing({});
  FaultyRobot robot(1, std::numeric_limits<double>::infinity());
  robot.alter_odometry = alter;
  robot.enter(nothing, {}, 1);
  PluginHost host([&] { robot.step({}); });
  const Pose2 corners[] = {{3.0, 0.0, 0.0}, {3.0, -3.0, 0.0}, {-20.0, -3.0, 0.0}};
  std::size_t corner = 0;
  const auto drive = [&] { host.drive(toMessage(corners[corner++], "odom")); };
  drive();
  const double begin = robot.robot().time();
  while (robot.robot().time() < begin + kDrive) {
    Twist2 command;
    if (host.step(&command) == PluginHost::State::kReached) drive();
    robot.step(command);
  }
  return robot.robot().pathLength() / kDrive;
}

class WrongTwistTest : public testing::TestWithParam<Publisher> {
 protected:
  /// From the first test on: what is said once is said once a process.
  static LogListener& log() {
    static LogListener log;
    return log;
  }
  void SetUp() override { log(); }
};

TEST_P(WrongTwistTest, IsNotBelievedAndSaidOnce) {
  static const double with_the_right_one = meanSpeed([](auto*) {});
  EXPECT_GT(with_the_right_one, 0.2) << "max_linear is 0.3 m/s";
  // It takes a second or two to notice.
  EXPECT_GE(meanSpeed(GetParam().alter), 0.9 * with_the_right_one);
  log().flush();
  EXPECT_EQ(
      log().count("the odometry on /odom contradicts itself: its twist says * m/s and * rad/s, its poses move by * "
                  "m/s and * rad/s"),
      1);
}

const Publisher kPublishers[] = {
    {"Zero", [](auto* odometry) { odometry->twist.twist = {}; }},
    {"InTheOdometryFrame",
     [](auto* odometry) {
       geometry_msgs::Vector3& speed = odometry->twist.twist.linear;
       const double yaw = fromMessage(odometry->pose.pose).yaw;
       speed.y = std::sin(yaw) * speed.x;
       speed.x = std::cos(yaw) * speed.x;
     }},
    {"Backwards", [](auto* odometry) { odometry->twist.twist.linear.x *= -1.0; }},
    {"InDegrees", [](auto* odometry) { odometry->twist.twist.angular.z *= 57.3; }},
};
INSTANTIATE_TEST_SUITE_P(Publishers, WrongTwistTest, testing::ValuesIn(kPublishers),
                         [](const auto& info) { return std::string(info.param.name); });

const RosProgram program("wrong_twists", &runTests);

}  // namespace
}  // namespace lstm_planner::wrong_twists
