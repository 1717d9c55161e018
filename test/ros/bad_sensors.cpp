// Planner and controller with sensors that lie: both refuse with the same sentence, the robot stands, and both go on
// when the sensors are well again. The clock stands still unless a test moves it.

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>

#include "ros/common/message_queue.hpp"
#include "ros/common/sensor_listener.hpp"
#include "ros/controller/steering_controller.hpp"
#include "ros/fixtures/planner_fixture.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::bad_sensors {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const ros::Time kEndOfTime(4294967295u, 0);

class BadSensorTest : public PlannerTest {
 protected:
  void SetUp() override {
    planner_ = makePlanner();
    controller_.initialize("SteeringController", &tf_, costmap_.get());
    ASSERT_TRUE(eventuallyBothGoOn());
  }
  void TearDown() override { ros::param::del("~/SteeringController"); }

  /// Renewed in each call, so that its age is no reason to stand.
  bool drives() {
    controller_.setPlan({stampedPose("odom", robot_.pose()), stampedPose("odom", {robot_.pose().x + 3.0, 0.0, 0.0})});
    const bool drives = controller_.computeVelocityCommands(velocity_);
    EXPECT_TRUE(drives || (velocity_.linear.x == 0.0 && velocity_.angular.z == 0.0));
    return drives;
  }

  bool eventuallyBothGoOn() {
    return eventually([&] {
      robot_.again();
      return preview(planner_.get()) && drives() && velocity_.linear.x > 0.0;
    });
  }

  /// Until both say the sentence: what is logged is throttled, and messages take their time.
  bool eventuallyBothRefuse(const std::string& sentence) {
    return eventually([&] {
      robot_.again();
      const bool refuse = !preview(planner_.get()) && !drives();
      return refuse && log_.count("no plan: " + sentence) > 0 && log_.count("the robot stands: " + sentence) > 0;
    });
  }

  std::unique_ptr<LstmGlobalPlanner> planner_;
  SteeringController controller_;
  geometry_msgs::Twist velocity_;
};

struct ScanLie {
  const char* name;
  std::function<void(sensor_msgs::LaserScan*)> tell;
  const char* sentence;
};
std::ostream& operator<<(std::ostream& out, const ScanLie& lie) { return out << lie.name; }

void setAll(sensor_msgs::LaserScan* scan, float range) { scan->ranges.assign(scan->ranges.size(), range); }

const ScanLie kScanLies[] = {
    {"NoBeams", [](auto* scan) { scan->ranges.clear(); }, "the scan has no ranges"},
    {"NanAngle", [](auto* scan) { scan->angle_min = kNan; }, "the scan has angle_min nan"},
    {"InfiniteAngle", [](auto* scan) { scan->angle_min = kInf; }, "the scan has angle_min inf"},
    {"NanIncrement", [](auto* scan) { scan->angle_increment = kNan; }, "the scan has angle_min"},
    {"InfiniteIncrement", [](auto* scan) { scan->angle_increment = kInf; }, "the scan has angle_min"},
    {"TinyIncrement", [](auto* scan) { scan->angle_increment = 1e-45F; }, "the scan has angle_min"},
    {"NoRange", [](auto* scan) { scan->range_max = 0.0F; }, "the scan has range_min"},
    {"InfiniteRangeMin", [](auto* scan) { scan->range_min = kInf; }, "the scan has range_min inf"},
    {"LooksBackwards", [](auto* scan) { scan->angle_min = static_cast<float>(M_PI_2); }, "the scan covers"},
    {"AllNan", [](auto* scan) { setAll(scan, kNan); }, "the scan has 0 of"},
    {"AllZero", [](auto* scan) { setAll(scan, 0.0F); }, "the scan has 0 of"},
    {"AllBelowRangeMin", [](auto* scan) { setAll(scan, 0.01F); }, "the scan has 0 of"},
    {"AllTooNear", [](auto* scan) { setAll(scan, -kInf); }, "the scan has 0 of"},
    {"AllNegative", [](auto* scan) { setAll(scan, -1.0F); }, "the scan has 0 of"},
    {"NoFrame", [](auto* scan) { scan->header.frame_id.clear(); }, "the scan on /scan names no frame"},
    {"UnknownFrame", [](auto* scan) { scan->header.frame_id = "lost"; }, "the pose of the scanner is not known"},
    {"InTheFuture", [](auto* scan) { scan->header.stamp += ros::Duration(10.0); },
     "the newest message on /scan is stamped * s in the future, allowed are scan_timeout = * s: the clocks differ"},
    {"AtTheEndOfTime", [](auto* scan) { scan->header.stamp = kEndOfTime; },
     "the newest message on /scan is stamped 429* s in the future, allowed are scan_timeout = "},
    {"Stuck", [](auto* scan) { scan->header.stamp = ros::Time(99.0); },
     "the newest message on /scan is * s old, allowed are scan_timeout = * s, although it has just come"},
};

class BadScanTest : public BadSensorTest, public testing::WithParamInterface<ScanLie> {};

TEST_P(BadScanTest, IsRefusedByBothUntilItIsWellAgain) {
  robot_.alter_scan = GetParam().tell;
  EXPECT_TRUE(eventuallyBothRefuse(GetParam().sentence)) << GetParam().sentence;
  robot_.alter_scan = [](auto*) {};
  EXPECT_TRUE(eventuallyBothGoOn());
}

INSTANTIATE_TEST_SUITE_P(Lies, BadScanTest, testing::ValuesIn(kScanLies),
                         [](const auto& info) { return std::string(info.param.name); });

struct OdometryLie {
  const char* name;
  std::function<void(nav_msgs::Odometry*)> tell;
  const char* sentence;
};
std::ostream& operator<<(std::ostream& out, const OdometryLie& lie) { return out << lie.name; }

const OdometryLie kOdometryLies[] = {
    {"NanPosition", [](auto* odometry) { odometry->pose.pose.position.x = kNan; },
     "the odometry on /odom has a pose or twist that is not finite"},
    {"ZeroQuaternion", [](auto* odometry) { odometry->pose.pose.orientation = geometry_msgs::Quaternion(); },
     "the odometry on /odom has a pose or twist that is not finite"},
    {"NanTwist", [](auto* odometry) { odometry->twist.twist.linear.x = kNan; },
     "the odometry on /odom has a pose or twist that is not finite"},
    {"NoFrame", [](auto* odometry) { odometry->header.frame_id.clear(); }, "the odometry on /odom names no frame"},
    {"InTheFuture", [](auto* odometry) { odometry->header.stamp += ros::Duration(10.0); },
     "the newest message on /odom is stamped * s in the future, allowed are odom_timeout = * s: the clocks differ"},
    {"AtTheEndOfTime", [](auto* odometry) { odometry->header.stamp = kEndOfTime; },
     "the newest message on /odom is stamped 429* s in the future, allowed are odom_timeout = "},
    {"Stuck", [](auto* odometry) { odometry->header.stamp = ros::Time(99.0); },
     "the newest message on /odom is * s old, allowed are odom_timeout = * s, although it has just come"},
};

class BadOdometryTest : public BadSensorTest, public testing::WithParamInterface<OdometryLie> {};

TEST_P(BadOdometryTest, IsRefusedByBothUntilItIsWellAgain) {
  robot_.alter_odometry = GetParam().tell;
  EXPECT_TRUE(eventuallyBothRefuse(GetParam().sentence)) << GetParam().sentence;
  robot_.alter_odometry = [](auto*) {};
  EXPECT_TRUE(eventuallyBothGoOn());
}

INSTANTIATE_TEST_SUITE_P(Lies, BadOdometryTest, testing::ValuesIn(kOdometryLies),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_F(BadSensorTest, RefusesToFollowAPlanThatWasMadeBeforeTheClockWasSetBack) {
  ros::param::set("~/SteeringController/plan_timeout",
                  1000.0);  // the only age that could stop it is not the limit here
  SteeringController controller;
  controller.initialize("SteeringController", &tf_, costmap_.get());
  ASSERT_TRUE(controller.setPlan({stampedPose("odom", {}), stampedPose("odom", {3.0, 0.0, 0.0})}));
  const auto drives = [&] {
    robot_.again();
    return controller.computeVelocityCommands(velocity_);
  };
  ASSERT_TRUE(eventually(drives));
  robot_.wait(-50.0);
  EXPECT_TRUE(
      eventually([&] { return !drives() && log_.count("the robot stands: the clock was set back by at least") > 0; }));
  ASSERT_TRUE(controller.setPlan({stampedPose("odom", {}), stampedPose("odom", {3.0, 0.0, 0.0})}));
  EXPECT_TRUE(eventually(drives)) << "with a new plan it goes on";
}

TEST_F(BadSensorTest, UnstampedScansHaveTheTimeWhenTheyWereReceived) {
  robot_.alter_scan = [](auto* scan) { scan->header.stamp = ros::Time(); };
  MessageQueue messages;
  SensorListener sensors(&messages, {}, "base_footprint", tf_);
  double stamp = 0.0;
  EXPECT_TRUE(eventually([&] {
    robot_.again();
    try {
      stamp = sensors.read(ros::Time::now()).first.stamp;
    } catch (const SensorError&) {
    }
    return stamp > 0.0;
  }));
  EXPECT_LE(stamp, ros::Time::now().toSec());
  EXPECT_GT(stamp, 100.0) << "the tests' clock starts there";
  EXPECT_TRUE(eventuallyBothGoOn());
}

TEST_F(BadSensorTest, AnOdometryThatNamesItsOwnFrameAsTheRobotsIsUsedAndSaid) {
  robot_.alter_odometry = [](auto* odometry) { odometry->child_frame_id = odometry->header.frame_id; };
  robot_.moveTo({5.0, 1.0, 0.5}, 30.0);
  EXPECT_TRUE(
      log_.eventuallyHas("the odometry on /odom contradicts itself: odom is its frame_id and its child_frame_id"));
  EXPECT_TRUE(eventuallyBothGoOn());
}

TEST_F(BadSensorTest, AnOdometryOfACameraLeadsTheBase) {
  const Pose2 camera{0.3, 0.1, M_PI};
  robot_.placeScanner("camera", camera, false);
  robot_.alter_odometry = [&](auto* odometry) {
    odometry->child_frame_id = "camera";
    odometry->pose.pose = toMessage(compose(fromMessage(odometry->pose.pose), camera));
  };
  MessageQueue messages;
  SensorListener sensors(&messages, {}, "base_footprint", tf_);
  const Pose2 base{5.0, 1.0, 0.5};
  robot_.moveTo(base, 30.0);
  EXPECT_TRUE(eventually([&] {
    robot_.again();
    const auto pose = sensors.newestPose();
    return pose && distanceBetween(*pose, base) < 1e-6 && std::abs(normalizeAngle(pose->yaw - base.yaw)) < 1e-6;
  }));
  EXPECT_TRUE(eventuallyBothGoOn());
}

TEST_F(BadSensorTest, AScanWhoseLastAngleDoesNotFitIsUsedAndSaid) {
  robot_.alter_scan = [](auto* scan) { scan->angle_max += 1.0F; };
  EXPECT_TRUE(eventuallyBothGoOn());
  EXPECT_TRUE(log_.eventuallyHas("the scans on /scan contradict themselves: 271 beams from angle_min = -2.35"));
}

/// A transform between odometry and the plan's frame.
geometry_msgs::TransformStamped localisation(const ros::Time& stamp) {
  return toMessage(Pose2{}, "odom", "world", stamp);
}

TEST_F(BadSensorTest, RefusesTransformsThatAreMissingOldOrOfTheFuture) {
  tf2_ros::TransformBroadcaster broadcaster;
  SteeringController controller;
  controller.initialize("SteeringController", &tf_, costmap_.get());
  double age = 0.0;
  const auto drives = [&] {
    robot_.again();
    if (std::isfinite(age)) broadcaster.sendTransform(localisation(ros::Time::now() - ros::Duration(age)));
    controller.setPlan({stampedPose("world", {}), stampedPose("world", {3.0, 0.0, 0.0})});
    return controller.computeVelocityCommands(velocity_);
  };
  const auto refuses = [&](const std::string& sentence) {
    return eventually([&] { return !drives() && log_.count("the robot stands: " + sentence) > 0; });
  };
  age = kInf;
  EXPECT_TRUE(refuses("no transform from world to odom")) << "missing";
  age = 0.0;
  EXPECT_TRUE(eventually(drives));
  age = kInf;
  EXPECT_TRUE(refuses("the newest transform from world to odom is * s old, allowed are tf_timeout = 0.3")) << "late";
  age = -1.0;
  EXPECT_TRUE(eventually(drives)) << "as amcl does with a transform_tolerance of 1 s";
  age = -5.0;
  EXPECT_TRUE(refuses("the newest transform from world to odom is stamped * s in the future, allowed are 3"));
}

TEST_F(BadSensorTest, ATransformOnItsWayWhenTheClockIsSetBackDoesNotStopThePlannerUntilItsStamp) {
  tf2_ros::TransformBroadcaster broadcaster;
  robot_.wait(100.0);
  const auto plansAt = [&](double ahead) {
    robot_.again();
    broadcaster.sendTransform(localisation(ros::Time::now() + ros::Duration(ahead)));
    return plan(planner_.get(), stampedPose("world", {3.0, 0.0, 0.0}));
  };
  ASSERT_TRUE(eventually([&] { return plansAt(0.0); }));
  robot_.wait(-8.0);
  const std::string reason = "no plan: the newest transform from world to odom is stamped";
  ASSERT_TRUE(eventually([&] { return !plansAt(8.0) && log_.count(reason) > 0; }));
  EXPECT_TRUE(eventually([&] { return plansAt(0.0); }));
}

TEST_F(BadSensorTest, AMessageThatCannotBeUsedDoesNotEndTheProcess) {
  MessageQueue messages;
  std::atomic<int> calls{0};
  const ros::Subscriber subscriber = messages.nodeHandle().subscribe<sensor_msgs::LaserScan>(
      "scan", 1, [&calls](const sensor_msgs::LaserScan::ConstPtr&) {
        ++calls;
        throw std::runtime_error("as tf does for a stamp at the end of time");
      });
  EXPECT_TRUE(eventually([&] {
    robot_.again();
    messages.handOut();
    return calls > 1 && log_.count("a message could not be used: as tf does for a stamp at the end of time") > 0;
  }));
}

TEST_F(BadSensorTest, RefusalsAfterAFatalErrorRepeatItsReason) {
  ros::param::set("~/SteeringController/max_linear", -1.0);
  SteeringController controller;
  controller.initialize("SteeringController", &tf_, costmap_.get());
  EXPECT_FALSE(controller.setPlan({stampedPose("odom", {})}));
  EXPECT_FALSE(controller.computeVelocityCommands(velocity_));
  ros::param::set("~/BadPlanner/model", "/nowhere/model.onnx");
  LstmGlobalPlanner planner;
  planner.initialize("BadPlanner", costmap_.get());
  EXPECT_FALSE(plan(&planner, stampedPose("odom", {3.0, 0.0, 0.0})));
  ros::param::del("~/BadPlanner");
  log_.flush();
  EXPECT_EQ(log_.count("the plan is not followed: the controller cannot be used: parameter max_linear is -1"), 1);
  EXPECT_EQ(log_.count("the robot stands: the controller cannot be used: parameter max_linear is -1"), 1);
  EXPECT_EQ(log_.count("no plan: the planner cannot be used: "), 1);
  EXPECT_GE(log_.count("/nowhere/model.onnx"), 2);
}

const RosProgram program("bad_sensors", &runTestsBesideSpinner);

}  // namespace
}  // namespace lstm_planner::bad_sensors
