// Both plugins with their shipped parameters drive in a field where nothing is within range of the scanner, whatever
// its driver sends for that, and stand when the same readings come from a lens that was covered. In lock step.

#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "lstm_planner/simulation/world.hpp"
#include "ros/fixtures/faulty_robot.hpp"
#include "ros/fixtures/log_listener.hpp"
#include "ros/fixtures/plugin_host.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::silent_scanners {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kNoFaults = std::numeric_limits<double>::infinity();
const Pose2 kGoal{5.0, 2.0, 0.0};

struct Driver {
  const char* name;
  float nothing;          ///< what it sends for "nothing within range"
  const char* no_return;  ///< the plugins' parameter; null: as shipped
};
std::ostream& operator<<(std::ostream& out, const Driver& driver) { return out << driver.name; }

class SilentScannerTest : public testing::Test {
 protected:
  void enter(const World& world, const Driver& driver) {
    for (const char* plugin : {"LstmGlobalPlanner", "SteeringController"}) {
      const std::string parameter = std::string("~/") + plugin + "/no_return";
      ros::param::get(parameter, shipped_);
      if (driver.no_return != nullptr) ros::param::set(parameter, driver.no_return);
    }
    robot_.pass_scan = [driver](sensor_msgs::LaserScan* scan) {
      std::replace(scan->ranges.begin(), scan->ranges.end(), kInf, driver.nothing);
      return true;
    };
    robot_.enter(world, {}, 1);
    host_ = std::make_unique<PluginHost>([this] { robot_.step({}); });
    host_->drive(toMessage(kGoal, "odom"));
  }
  void TearDown() override {
    for (const char* plugin : {"LstmGlobalPlanner", "SteeringController"}) {
      ros::param::set(std::string("~/") + plugin + "/no_return", shipped_);
    }
  }

  PluginHost::State step() {
    Twist2 command;
    const PluginHost::State state = host_->step(&command);
    robot_.step(command);
    return state;
  }

  void driveFor(double seconds) {
    for (double passed = 0.0; passed < seconds; passed += FaultyRobot::kPeriod) step();
  }

  void expectArrives() {
    PluginHost::State state = PluginHost::State::kDriving;
    for (double passed = 0.0; passed < 60.0 && state == PluginHost::State::kDriving; passed += FaultyRobot::kPeriod) {
      state = step();
    }
    EXPECT_EQ(state, PluginHost::State::kReached);
    // position_tolerance is 0.2 m; 2 % of odometry error is up to 0.1 m.
    EXPECT_LT(distanceBetween(robot_.robot().odometry(), kGoal), 0.3);
    EXPECT_EQ(robot_.robot().contacts(), 0);
  }

  FaultyRobot robot_{1, kNoFaults};
  std::unique_ptr<PluginHost> host_;
  LogListener log_;

 private:
  std::string shipped_;
};

class OpenFieldTest : public SilentScannerTest, public testing::WithParamInterface<Driver> {};

TEST_P(OpenFieldTest, IsDriven) {
  const CircleWorld nothing({});
  enter(nothing, GetParam());
  expectArrives();
}

const Driver kHokuyo = {"NanWithTheShippedRules", kNan, nullptr};
INSTANTIATE_TEST_SUITE_P(Drivers, OpenFieldTest, testing::Values(kHokuyo, Driver{"InfinityWithoutRules", kInf, ""}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_F(SilentScannerTest, ALensThatIsCoveredWhileTheScannerPausesIsNoOpenField) {
  std::vector<Circle> posts;
  for (int i = 0; i < 100; ++i) posts.push_back({pointAlong(Pose2{2.5, 1.0, 0.0}, 0.02 * M_PI * i, 5.0), 0.2});
  const CircleWorld fence(posts);
  enter(fence, kHokuyo);
  driveFor(3.0);
  ASSERT_GT(robot_.robot().truePose().x, 0.3) << "it is on its way";

  const auto pass = robot_.pass_scan;
  robot_.pass_scan = [](auto*) { return false; };
  driveFor(1.0);
  const double driven = robot_.robot().pathLength();
  robot_.pass_scan = [](sensor_msgs::LaserScan* scan) {
    scan->ranges.assign(scan->ranges.size(), kNan);
    return true;
  };
  driveFor(3.0);
  EXPECT_LT(robot_.robot().pathLength() - driven, 0.01);
  EXPECT_TRUE(log_.eventuallyHas("the robot stands: the scanner counts as covered: on /scan no beam has had a return"));

  robot_.pass_scan = pass;
  expectArrives();
}

const RosProgram program("silent_scanners", &runTests);

}  // namespace
}  // namespace lstm_planner::silent_scanners
