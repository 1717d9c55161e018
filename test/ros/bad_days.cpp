// The robot drives, and something breaks: it stands within half a second, says why, touches nothing, and goes on when
// all is well again. Move_base (or standalone_move_base) hosts both plugins with their shipped parameters.

#include <actionlib/client/simple_action_client.h>
#include <diagnostic_msgs/DiagnosticStatus.h>
#include <gtest/gtest.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/UInt32.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <ostream>
#include <string>

#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/fixtures/callback_thread.hpp"
#include "ros/fixtures/fake_robot.hpp"
#include "ros/fixtures/log_listener.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::bad_days {
namespace {

using Client = actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction>;

/// Far apart, so that the robot is still on its way when something breaks (map frame).
const Pose2 kGoals[] = {{6.5, 1.25, 0.0}, {2.0, 8.25, 0.0}};

constexpr double kStandsWithin = 0.5;  // s
constexpr double kPlanTimeout = 2.0;   // s, as shipped; the last plan may be made from a scan of
constexpr double kScanTimeout = 0.5;   // s before
constexpr double kTfTimeout = 0.3;     // s, the controller's, as shipped
constexpr double kPoseTimeout = 0.5;   // s, the costmap's, as shipped
constexpr double kWatched = 1.0;       // s after which it must still stand
constexpr double kStill = 0.01;        // m/s

/// How messages get from the robot to move_base. Each returns false for a message that is lost.
struct Passage {
  std::function<bool(sensor_msgs::LaserScan*)> scan = [](auto*) { return true; };
  std::function<bool(sensor_msgs::LaserScan*)> planners_scan = [](auto*) { return true; };
  std::function<bool(nav_msgs::Odometry*)> odometry = [](auto*) { return true; };
  std::function<bool(rosgraph_msgs::Clock*)> clock = [](auto*) { return true; };
  std::function<bool(geometry_msgs::TransformStamped*)> transform = [](auto*) { return true; };
};

/// Passes the robot's messages on, and watches what it really does.
class Relay {
 public:
  Relay() {
    ros::NodeHandle node = callbacks_.nodeHandle();
    scans_ = node.advertise<sensor_msgs::LaserScan>("scan", 1);
    planners_scans_ = node.advertise<sensor_msgs::LaserScan>("planners_scan", 1);
    odometry_ = node.advertise<nav_msgs::Odometry>("odom", 10);
    clock_ = node.advertise<rosgraph_msgs::Clock>("/clock", 10);
    transforms_ = node.advertise<tf2_msgs::TFMessage>("/tf", 10);
    static_transforms_ = node.advertise<tf2_msgs::TFMessage>("/tf_static", 1, true);
    const auto hints = ros::TransportHints().tcpNoDelay();
    subscribers_ = {node.subscribe("true_scan", 1, &Relay::onScan, this, hints),
                    node.subscribe("true_odom", 10, &Relay::onOdometry, this, hints),
                    node.subscribe("/true_clock", 10, &Relay::onClock, this, hints),
                    node.subscribe("/true_tf", 10, &Relay::onTransforms, this, hints),
                    node.subscribe("/true_tf_static", 1, &Relay::onStaticTransforms, this, hints),
                    node.subscribe("create2_stub/ground_truth", 10, &Relay::onTruth, this, hints),
                    node.subscribe("create2_stub/contacts", 10, &Relay::onContacts, this)};
  }

  /// Returns when it is done, the time (s) of the robot's own clock.
  double use(const Passage& passage) {
    const std::lock_guard<std::mutex> lock(mutex_);
    passage_ = passage;
    return time_;
  }

  double time() const { return locked(time_); }
  double lastMotion() const { return locked(last_motion_); }
  double speed() const { return locked(speed_); }
  unsigned contacts() const { return locked(contact_count_); }
  Pose2 pose() const { return locked(pose_); }

 private:
  template <typename T>
  T locked(const T& value) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return value;
  }

  void onScan(const sensor_msgs::LaserScan::ConstPtr& scan) {
    const std::lock_guard<std::mutex> lock(mutex_);
    sensor_msgs::LaserScan passed = *scan;
    if (passage_.scan(&passed)) scans_.publish(passed);
    sensor_msgs::LaserScan planners = *scan;
    if (passage_.scan(&planners) && passage_.planners_scan(&planners)) planners_scans_.publish(planners);
  }
  void onOdometry(const nav_msgs::Odometry::ConstPtr& odometry) {
    const std::lock_guard<std::mutex> lock(mutex_);
    nav_msgs::Odometry passed = *odometry;
    if (passage_.odometry(&passed)) odometry_.publish(passed);
  }
  void onClock(const rosgraph_msgs::Clock::ConstPtr& clock) {
    const std::lock_guard<std::mutex> lock(mutex_);
    rosgraph_msgs::Clock passed = *clock;
    if (passage_.clock(&passed)) clock_.publish(passed);
  }
  /// What a localisation says comes along with each transform of the odometry.
  void onTransforms(const tf2_msgs::TFMessage::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    tf2_msgs::TFMessage passed;
    for (geometry_msgs::TransformStamped transform : message->transforms) {
      odometry_in_map_.header.stamp = transform.header.stamp;
      geometry_msgs::TransformStamped localisation = odometry_in_map_;
      if (passage_.transform(&transform)) passed.transforms.push_back(transform);
      if (passage_.transform(&localisation)) passed.transforms.push_back(localisation);
    }
    transforms_.publish(passed);
  }
  void onStaticTransforms(const tf2_msgs::TFMessage::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    tf2_msgs::TFMessage passed;
    for (const auto& transform : message->transforms) {
      if (transform.header.frame_id == "map") {
        odometry_in_map_ = transform;
      } else {
        passed.transforms.push_back(transform);
      }
    }
    static_transforms_.publish(passed);
  }
  void onTruth(const nav_msgs::Odometry::ConstPtr& truth) {
    const std::lock_guard<std::mutex> lock(mutex_);
    time_ = truth->header.stamp.toSec();
    pose_ = fromMessage(truth->pose.pose);
    speed_ = std::abs(truth->twist.twist.linear.x) + 0.1 * std::abs(truth->twist.twist.angular.z);
    if (speed_ >= kStill) last_motion_ = time_;
  }
  void onContacts(const std_msgs::UInt32::ConstPtr& contacts) {
    const std::lock_guard<std::mutex> lock(mutex_);
    contact_count_ = contacts->data;
  }

  mutable std::mutex mutex_;
  Passage passage_;
  double time_ = 0.0;
  double last_motion_ = 0.0;
  double speed_ = 0.0;
  unsigned contact_count_ = 0;
  Pose2 pose_;
  geometry_msgs::TransformStamped odometry_in_map_;
  CallbackThread callbacks_;
  ros::Publisher scans_;
  ros::Publisher planners_scans_;
  ros::Publisher odometry_;
  ros::Publisher clock_;
  ros::Publisher transforms_;
  ros::Publisher static_transforms_;
  std::vector<ros::Subscriber> subscribers_;
};

/// One for all tests: without it the clock would stand.
Relay& relay() {
  static Relay relay;
  return relay;
}

/// One for all tests: what a node says before it has noticed a new listener is lost.
LogListener& log() {
  static LogListener log;
  return log;
}

class BadDayTest : public testing::Test {
 protected:
  void SetUp() override {
    log();
    ASSERT_TRUE(eventually([] { return relay().time() > 0.0; }));
    ASSERT_TRUE(client_.waitForServer(ros::Duration(60.0)));
    drive();
  }
  void TearDown() override {
    relay().use({});
    // The next test has a client of its own: a cancellation still on its way would take that one's goal away.
    client_.cancelAllGoals();
    EXPECT_TRUE(eventually([&] { return client_.getState().isDone() && relay().speed() < kStill; }));
    EXPECT_EQ(relay().contacts(), 0u);
  }

  /// To the goal that is farther away.
  void drive() {
    const Pose2 here = relay().pose();
    const bool first = distanceBetween(here, kGoals[0]) > distanceBetween(here, kGoals[1]);
    move_base_msgs::MoveBaseGoal goal;
    goal.target_pose = toMessage(kGoals[first ? 0 : 1], "map");
    client_.sendGoal(goal);
    ASSERT_TRUE(eventually([] { return relay().speed() > 0.15; }));
  }

  /// Breaks something, and expects that the robot stands soon and says why.
  void expectStands(const Passage& fault, double within, const std::string& sentence) {
    const int before = log().count(sentence);
    const double begin = relay().use(fault);
    ASSERT_TRUE(eventually([&] { return relay().time() > begin + within + kWatched; }));
    EXPECT_LE(relay().lastMotion() - begin, within) << "s until it stood";
    EXPECT_TRUE(eventually([&] { return log().count(sentence) > before; })) << sentence;
  }

  /// All is well again. A goal that was given up meanwhile is given again.
  void expectGoesOn() {
    relay().use({});
    EXPECT_TRUE(eventually([&] {
      if (client_.getState().isDone()) drive();
      return relay().speed() > 0.1;
    }));
  }

  Client client_{"move_base", true};
};

struct Fault {
  const char* name;
  Passage passage;
  const char* sentence;
  double within = kStandsWithin;
};
std::ostream& operator<<(std::ostream& out, const Fault& fault) { return out << fault.name; }

Passage scans(const std::function<void(sensor_msgs::LaserScan*)>& spoil) {
  Passage passage;
  passage.scan = [spoil](auto* scan) { return spoil(scan), true; };
  return passage;
}
Passage odometry(const std::function<void(nav_msgs::Odometry*)>& spoil) {
  Passage passage;
  passage.odometry = [spoil](auto* odometry) { return spoil(odometry), true; };
  return passage;
}

/// Spoils where the odometry sits in the map.
Passage localisation(const std::function<bool(geometry_msgs::TransformStamped*)>& pass) {
  Passage passage;
  passage.transform = [pass](auto* transform) { return transform->header.frame_id != "map" || pass(transform); };
  return passage;
}
Passage localisationAt(double seconds) {
  return localisation([seconds](auto* transform) { return transform->header.stamp += ros::Duration(seconds), true; });
}

Passage noTransforms() {
  Passage passage;
  passage.transform = [](auto*) { return false; };
  return passage;
}
/// Spoils where the robot is by its odometry; the planner's host looks it up.
Passage odometryTransform(const std::function<bool(geometry_msgs::TransformStamped*)>& pass) {
  Passage passage;
  passage.transform = [pass](auto* transform) { return transform->header.frame_id != "odom" || pass(transform); };
  return passage;
}

Passage noScans() {
  Passage passage;
  passage.scan = [](auto*) { return false; };
  return passage;
}
Passage noOdometry() {
  Passage passage;
  passage.odometry = [](auto*) { return false; };
  return passage;
}
Passage noScansForThePlanner() {
  Passage passage;
  passage.planners_scan = [](auto*) { return false; };
  return passage;
}
Passage clockThatStands() {
  Passage passage;
  passage.clock = [](auto*) { return false; };
  return passage;
}
/// As by a simulator that starts again, and the robot is not there yet.
Passage clockSetBack(double seconds) {
  Passage passage = noScans();
  passage.clock = [seconds](auto* clock) { return clock->clock -= ros::Duration(seconds), true; };
  return passage;
}

void setAll(sensor_msgs::LaserScan* scan, float range) { scan->ranges.assign(scan->ranges.size(), range); }

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const ros::Time kEndOfTime(4294967295u, 0);
const ros::Time kBeginning(1.0);

const Fault kFaults[] = {
    {"ScansStop", noScans(), "the robot stands: the newest message on /scan is * s old, allowed are scan_timeout = "},
    {"ScansWithoutBeams", scans([](auto* scan) { scan->ranges.clear(); }), "the robot stands: the scan has no ranges"},
    {"ScansWithNanAngles", scans([](auto* scan) { scan->angle_min = kNan; }),
     "the robot stands: the scan has angle_min nan"},
    {"ScansWithInfiniteAngles", scans([](auto* scan) { scan->angle_min = kInf; }),
     "the robot stands: the scan has angle_min inf"},
    {"ScansWithNanIncrement", scans([](auto* scan) { scan->angle_increment = kNan; }),
     "the robot stands: the scan has angle_min"},
    {"ScansWithInfiniteIncrement", scans([](auto* scan) { scan->angle_increment = kInf; }),
     "the robot stands: the scan has angle_min"},
    {"ScansWithTinyIncrement", scans([](auto* scan) { scan->angle_increment = 1e-45F; }),
     "the robot stands: the scan has angle_min"},
    {"ScansWithoutIncrement", scans([](auto* scan) { scan->angle_increment = 0.0F; }),
     "the robot stands: the scan has angle_min"},
    {"ScansWithoutReach", scans([](auto* scan) { scan->range_max = 0.0F; }),
     "the robot stands: the scan has range_min"},
    {"ScansWithInfiniteRangeMin", scans([](auto* scan) { scan->range_min = kInf; }),
     "the robot stands: the scan has range_min inf"},
    {"ScansThatLookBackwards", scans([](auto* scan) { scan->angle_min += 3.0F; }), "the robot stands: the scan covers"},
    {"ScannerCovered", scans([](auto* scan) { setAll(scan, 0.01F); }), "the robot stands: the scan has 0 of"},
    {"ScannerTouched", scans([](auto* scan) { setAll(scan, -kInf); }), "the robot stands: the scan has 0 of"},
    {"ScannerHalfCovered", scans([](auto* scan) { std::fill(scan->ranges.begin() + 540, scan->ranges.end(), 0.01F); }),
     "the robot stands: the scan has"},
    {"ScannerCoveredInTheDriversCode", scans([](auto* scan) { setAll(scan, kNan); }),
     "the robot stands: the scanner counts as covered"},
    {"ScannerCoveredInItsOtherCode", scans([](auto* scan) { setAll(scan, 0.0F); }),
     "the robot stands: the scanner counts as covered"},
    {"ScannerThatFailsWithInfinity", scans([](auto* scan) { setAll(scan, kInf); }),
     "the robot stands: the scanner counts as covered"},
    {"ScansStuck", scans([](auto* scan) { scan->header.stamp = kBeginning; }),
     "the robot stands: the newest message on /scan is * s old, allowed are scan_timeout = "},
    {"ScansOfTheFuture", scans([](auto* scan) { scan->header.stamp += ros::Duration(60.0); }),
     "the robot stands: the newest message on /scan is stamped * s in the future, allowed are scan_timeout = "},
    {"ScansOfThePast", scans([](auto* scan) { scan->header.stamp -= ros::Duration(5.0); }),
     "the robot stands: the newest message on /scan is * s old, allowed are scan_timeout = "},
    {"ScansAtTheEndOfTime", scans([](auto* scan) { scan->header.stamp = kEndOfTime; }),
     "the robot stands: the newest message on /scan is stamped * s in the future, allowed are scan_timeout = "},
    {"ScansWithoutFrame", scans([](auto* scan) { scan->header.frame_id.clear(); }),
     "the robot stands: the scan on /scan names no frame"},
    {"ScansInAnotherFrame", scans([](auto* scan) { scan->header.frame_id = "elsewhere"; }),
     "the robot stands: the pose of the scanner is not known"},
    {"OdometryStops", noOdometry(),
     "the robot stands: the newest message on /odom is * s old, allowed are odom_timeout = "},
    {"OdometryNan", odometry([](auto* odometry) { odometry->pose.pose.position.y = kNan; }),
     "the robot stands: the odometry on /odom has a pose or twist that is not finite"},
    {"OdometryWithoutRotation",
     odometry([](auto* odometry) { odometry->pose.pose.orientation = geometry_msgs::Quaternion(); }),
     "the robot stands: the odometry on /odom has a pose or twist that is not finite"},
    {"OdometryWithoutFrame", odometry([](auto* odometry) { odometry->header.frame_id.clear(); }),
     "the robot stands: the odometry on /odom names no frame"},
    {"OdometryInAnotherFrame", odometry([](auto* odometry) { odometry->header.frame_id = "odom_2"; }),
     "the robot stands: no transform from odom to odom_2"},
    {"OdometryStuck", odometry([](auto* odometry) { odometry->header.stamp = kBeginning; }),
     "the robot stands: the newest message on /odom is * s old, allowed are odom_timeout = "},
    {"OdometryAtTheEndOfTime", odometry([](auto* odometry) { odometry->header.stamp = kEndOfTime; }),
     "the robot stands: the newest message on /odom is stamped * s in the future, allowed are odom_timeout = "},
    {"PlanIsNotRenewed", noScansForThePlanner(),
     "the robot stands: the plan is * s old, allowed are plan_timeout = ", kScanTimeout + kPlanTimeout + kStandsWithin},
    {"ClockSetBack", clockSetBack(30.0),
     "the robot stands: the clock was set back by at least * s since the newest message on /scan came"},
};

/// With the plans' frame connected to the odometry by a localisation.
const Fault kTransformFaults[] = {
    {"Missing", localisation([](auto*) { return false; }),
     "the robot stands: the newest transform from map to odom is * s old, allowed are tf_timeout = ",
     kTfTimeout + kStandsWithin},
    {"Late", localisationAt(-5.0),
     "the robot stands: the newest transform from map to odom is * s old, allowed are tf_timeout = ",
     kTfTimeout + kStandsWithin},
    {"FarInTheFuture", localisationAt(1000.0),
     "the transform from odom to map by /bad_transforms is not used: it is stamped", kTfTimeout + kStandsWithin},
    {"AtTheEndOfTime", localisation([](auto* transform) { return transform->header.stamp = kEndOfTime, true; }),
     "the transform from odom to map by /bad_transforms is not used: it is stamped 4294967295",
     kTfTimeout + kStandsWithin},
    {"Nan", localisation([](auto* transform) { return transform->transform.translation.x = kNan, true; }),
     "the robot stands: the newest transform from map to odom is * s old, allowed are tf_timeout = ",
     kTfTimeout + kStandsWithin},
    {"WithoutRotation", localisation([](auto* transform) { return transform->transform.rotation.w = 0.0, true; }),
     "the robot stands: the newest transform from map to odom is * s old, allowed are tf_timeout = ",
     kTfTimeout + kStandsWithin},
    {"NoneAtAll", noTransforms(),
     "the robot stands: the newest transform from map to odom is * s old, allowed are tf_timeout = ",
     kTfTimeout + kStandsWithin},
    {"OdometryMissing", odometryTransform([](auto*) { return false; }),
     "the robot stands: the plan is * s old, allowed are plan_timeout = ", kPoseTimeout + kPlanTimeout + kStandsWithin},
    {"OdometryAtTheEndOfTime",
     odometryTransform([](auto* transform) { return transform->header.stamp = kEndOfTime, true; }),
     "the robot stands: the plan is * s old, allowed are plan_timeout = ", kPoseTimeout + kPlanTimeout + kStandsWithin},
    // The last one: tf keeps its transforms, which can be used for some seconds afterwards.
    {"InTheFuture", localisationAt(5.0),
     "the robot stands: the newest transform from map to odom is stamped * s in the future, allowed are 3",
     kTfTimeout + kStandsWithin},
};

class FaultTest : public BadDayTest, public testing::WithParamInterface<Fault> {};

TEST_P(FaultTest, TheRobotStandsSaysWhyAndGoesOnAfterwards) {
  expectStands(GetParam().passage, GetParam().within, GetParam().sentence);
  expectGoesOn();
}

INSTANTIATE_TEST_SUITE_P(Sensors, FaultTest, testing::ValuesIn(kFaults),
                         [](const auto& info) { return std::string(info.param.name); });

// In bad_transforms.test.
INSTANTIATE_TEST_SUITE_P(Transforms, FaultTest, testing::ValuesIn(kTransformFaults),
                         [](const auto& info) { return std::string(info.param.name); });

// Nobody asks the plugins then, so that they log nothing; their status goes by the computer's clock.
TEST_F(BadDayTest, StandsWhileTheClockStandsAndTheStatusSaysSo) {
  std::mutex mutex;
  std::string status;
  CallbackThread callbacks;
  const ros::Subscriber subscriber = callbacks.nodeHandle().subscribe<diagnostic_msgs::DiagnosticStatus>(
      "move_base/SteeringController/status", 1, [&](const diagnostic_msgs::DiagnosticStatus::ConstPtr& message) {
        const std::lock_guard<std::mutex> lock(mutex);
        status = message->message;
      });
  const double start = relay().use(clockThatStands());
  ASSERT_TRUE(eventually([&] { return relay().time() > start + kStandsWithin + kWatched; }));
  EXPECT_LE(relay().lastMotion() - start, kStandsWithin) << "s until it stood";
  EXPECT_TRUE(eventually([&] {
    const std::lock_guard<std::mutex> lock(mutex);
    return status.rfind("the clock stands still", 0) == 0;
  })) << status;
  expectGoesOn();
}

TEST_F(BadDayTest, DrivesOnWithoutStamps) {
  Passage unstamped = scans([](auto* scan) { scan->header.stamp = ros::Time(); });
  unstamped.odometry = [](auto* odometry) { return odometry->header.stamp = ros::Time(), true; };
  const double begin = relay().use(unstamped);
  ASSERT_TRUE(eventually([&] { return relay().time() > begin + 2.0; }));
  EXPECT_TRUE(eventually([&] { return relay().speed() > 0.1; }));
}

const RosProgram program("bad_days", [] {
  relay();
  return runTestsBesideSpinner();
});

}  // namespace
}  // namespace lstm_planner::bad_days
