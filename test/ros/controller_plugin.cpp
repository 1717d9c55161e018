// The controller under move_base. The clock stands still unless a test moves it.

#include <gtest/gtest.h>
#include <ros/package.h>

#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <pluginlib/class_loader.hpp>

#include "ros/controller/steering_controller.hpp"
#include "ros/fixtures/diagnostics_listener.hpp"
#include "ros/fixtures/planner_fixture.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::controller_plugin {
namespace {

Plan straightPlan(const std::string& frame, const Pose2& from, double length) {
  Plan plan;
  for (double at = 0.0; at <= length + 1e-9; at += 0.05) {
    const Point2 position = pointAlong(from, from.yaw, at);
    plan.push_back(stampedPose(frame, {position.x, position.y, from.yaw}));
  }
  return plan;
}

class ControllerTest : public PlannerTest {
 protected:
  void SetUp() override { initialise(); }
  void TearDown() override { ros::param::del("~/SteeringController"); }

  void initialise() {
    controller_ = std::make_unique<SteeringController>();
    controller_->initialize("SteeringController", &tf_, costmap_.get());
    EXPECT_TRUE(controller_->setPlan(straightPlan("odom", robot_.pose(), 3.0)));
    EXPECT_TRUE(eventually([&] {
      robot_.again();
      controller_->setPlan(straightPlan("odom", robot_.pose(), 3.0));
      return controller_->computeVelocityCommands(velocity_);
    }));
  }

  /// The robot stands at `pose`; true when the controller, having heard of it, gives a velocity.
  bool computeAt(const Pose2& pose, double seconds = 0.05) {
    robot_.moveTo(pose, seconds);
    return eventually([&] {
      robot_.again();
      return controller_->computeVelocityCommands(velocity_);
    });
  }

  /// Expects that the controller lets the robot stand, and that the log says why.
  void expectStands(const std::string& reason, const std::function<void()>& pass) {
    log_.expectRefusal([&] { return controller_->computeVelocityCommands(velocity_); }, "the robot stands: " + reason,
                       pass);
    EXPECT_TRUE(stands());
  }
  bool stands() const { return velocity_.linear.x == 0.0 && velocity_.angular.z == 0.0; }

  std::unique_ptr<SteeringController> controller_;
  geometry_msgs::Twist velocity_;
};

TEST_F(ControllerTest, DrivesStraightAlongAStraightPlan) {
  EXPECT_GT(velocity_.linear.x, 0.0);
  EXPECT_NEAR(velocity_.angular.z, 0.0, 1e-6);
}

TEST_F(ControllerTest, StandsWithoutAPlanAndWithAnEmptyOne) {
  EXPECT_TRUE(controller_->setPlan({}));
  expectStands("there is no plan to follow", [&] { stand(kLogPeriod); });
  EXPECT_FALSE(controller_->isGoalReached());
}

TEST_F(ControllerTest, StandsWhileTheScanIsOldAndGoesOnWhenItReturns) {
  expectStands("the newest message on /scan is 0.25* s old, allowed are scan_timeout = 0.2", [&] {
    stand(kLogPeriod);
    robot_.wait(0.25);  // three periods of 0.05 s are less than the shortest timeout, 0.2 s; of odometry 0.3 s
  });
  // Elsewhere: many attempts to see the reason may have taken longer than the patience with one place.
  const Pose2 further{0.2, 0.0, 0.0};
  controller_->setPlan(straightPlan("odom", further, 3.0));
  EXPECT_TRUE(computeAt(further));
  EXPECT_GT(velocity_.linear.x, 0.0);
}

TEST_F(ControllerTest, WaitsLongerForAScannerThatIsSlower) {
  const auto renewPlan = [&] { controller_->setPlan(straightPlan("odom", robot_.pose(), 3.0)); };
  for (int i = 0; i < 20; ++i) {
    renewPlan();
    EXPECT_TRUE(computeAt(robot_.pose()));
  }
  for (int i = 0; i < 20; ++i) {  // an LDS-01, at 5 Hz
    robot_.wait(0.1);
    robot_.publishOdometry();
    robot_.moveTo(robot_.pose(), 0.1);
    renewPlan();
    EXPECT_TRUE(eventually([&] { return controller_->computeVelocityCommands(velocity_); }));
  }
  robot_.wait(0.45);
  robot_.publishOdometry();
  EXPECT_TRUE(eventually([&] { return controller_->computeVelocityCommands(velocity_); })) << "up to 0.6 s";
  expectStands("the newest message on /scan is 0.65* s old, allowed are scan_timeout = 0.6", [&] {
    stand(kLogPeriod);
    robot_.wait(0.65);
    robot_.publishOdometry();
  });
}

TEST_F(ControllerTest, StandsWhileTheOdometryIsOld) {
  expectStands("the newest message on /odom is 0.35* s old, allowed are odom_timeout = 0.3", [&] {
    stand(kLogPeriod);
    robot_.wait(0.35);
    robot_.publishScan();
  });
  EXPECT_FALSE(controller_->isGoalReached());
}

TEST_F(ControllerTest, StandsWhenThePlanIsNotRenewed) {
  EXPECT_TRUE(controller_->setPlan(straightPlan("odom", {}, 3.0)));
  EXPECT_TRUE(computeAt(robot_.pose()));
  expectStands("the plan is 2.* s old, allowed are plan_timeout = 2 s", [&] { robot_.again(); });
  EXPECT_FALSE(controller_->isGoalReached());
  controller_->setPlan(straightPlan("odom", robot_.pose(), 3.0));
  EXPECT_TRUE(computeAt(robot_.pose()));
}

TEST_F(ControllerTest, StandsAfterAJumpOfTheOdometryUntilThereIsANewPlan) {
  ros::param::set("~/SteeringController/plan_timeout", 100.0);  // however busy the computer is
  initialise();
  EXPECT_TRUE(controller_->setPlan(straightPlan("odom", {}, 3.0)));
  EXPECT_TRUE(computeAt(robot_.pose()));
  robot_.moveTo({3.0, 0.0, 0.0}, 0.05);
  // Time that passes while the controller hears nothing would make a drive of the jump.
  EXPECT_TRUE(eventually([&] { return !controller_->computeVelocityCommands(velocity_); }));
  expectStands("the odometry has jumped since the plan was made", [&] { robot_.again(); });
  EXPECT_FALSE(controller_->isGoalReached()) << "it is where the old plan ends";
  controller_->setPlan(straightPlan("odom", robot_.pose(), 3.0));
  EXPECT_TRUE(computeAt(robot_.pose()));
}

TEST_F(ControllerTest, FollowsAPlanInAnotherFrame) {
  Plan plan;
  for (const auto& pose : straightPlan("odom", {}, 3.0)) {
    plan.push_back(stampedPose("map", compose(robot_.odometryInMap(), fromMessage(pose.pose))));
  }
  EXPECT_TRUE(controller_->setPlan(plan));
  ASSERT_TRUE(computeAt({}));
  EXPECT_GT(velocity_.linear.x, 0.0);
  EXPECT_NEAR(velocity_.angular.z, 0.0, 1e-6);
}

TEST_F(ControllerTest, FollowsAPlanWithoutHeadings) {
  auto plan = straightPlan("odom", {}, 3.0);
  for (auto& pose : plan) pose.pose.orientation = geometry_msgs::Quaternion();
  EXPECT_TRUE(controller_->setPlan(plan));
  ASSERT_TRUE(computeAt({}));
  EXPECT_GT(velocity_.linear.x, 0.0);
}

TEST_F(ControllerTest, RefusesAPlanThatIsNotFiniteOrNotInOneFrame) {
  auto plan = straightPlan("odom", {}, 1.0);
  plan[3].pose.position.x = std::numeric_limits<double>::quiet_NaN();
  const auto expectRefused = [&](const std::string& reason) {
    log_.expectRefusal([&] { return controller_->setPlan(plan); }, "the plan is not followed: " + reason,
                       [&] { stand(kLogPeriod); });
    // The last plan is not followed either.
    expectStands("there is no plan to follow", [&] { stand(kLogPeriod); });
  };
  expectRefused("the plan has a pose that is not finite");
  plan = straightPlan("odom", {}, 1.0);
  plan.back().header.frame_id = "map";
  expectRefused("the plan has a pose in frame 'map', expected 'odom'");
}

TEST_F(ControllerTest, ArrivesWithinThePositionTolerance) {
  controller_->setPlan(straightPlan("odom", {}, 1.0));
  ASSERT_TRUE(computeAt({0.75, 0.0, 0.0}, 1.0));
  EXPECT_FALSE(controller_->isGoalReached()) << "0.25 m away, the tolerance is 0.2 m";
  ASSERT_TRUE(computeAt({0.85, 0.0, 1.0}, 0.5));
  EXPECT_TRUE(eventually([&] { return controller_->isGoalReached(); })) << "any heading will do";
}

TEST_F(ControllerTest, TurnsToTheGoalsHeadingWhenTheToleranceAsksForIt) {
  ros::param::set("~/SteeringController/heading_tolerance", 0.2);
  initialise();
  controller_->setPlan(straightPlan("odom", {}, 1.0));
  ASSERT_TRUE(computeAt({0.9, 0.0, 1.0}, 1.0));
  EXPECT_TRUE(eventually([&] {
    return controller_->computeVelocityCommands(velocity_) && velocity_.linear.x == 0.0 && velocity_.angular.z < -0.5;
  }));
  EXPECT_FALSE(controller_->isGoalReached());
  ASSERT_TRUE(computeAt({0.9, 0.0, 0.1}, 0.5));
  EXPECT_TRUE(eventually([&] { return controller_->isGoalReached(); }));
}

TEST_F(ControllerTest, DoesNotDriveIntoWhatTheScanShows) {
  // The scanner is 0.1 m ahead of the centre, the footprint's radius 0.174 m: the gap is 0.02 m, the margin 0.03 m.
  robot_.range = [](double angle) { return std::abs(angle) < 0.3 ? 0.0943F : 4.0F; };
  EXPECT_TRUE(eventually([&] {
    robot_.again();
    return controller_->computeVelocityCommands(velocity_) && velocity_.linear.x == 0.0;
  }));
}

/// A robot that has braked: its speed does not tell any more how far it has come.
TEST_F(ControllerTest, KnowsHowFarItHasComeSinceTheScan) {
  // A gap of 0.08 m, of which 0.06 m are driven by the odometry alone; the margin is 0.03 m.
  robot_.range = [](double angle) { return std::abs(angle) < 0.3 ? 0.1543F : 4.0F; };
  ASSERT_TRUE(eventually([&] {
    robot_.again();
    return controller_->computeVelocityCommands(velocity_) && velocity_.linear.x > 0.0 && velocity_.linear.x < 0.2;
  }));
  double come = 0.0;
  double speed = 0.3;
  robot_.alter_odometry = [&](nav_msgs::Odometry* odometry) {
    odometry->pose.pose.position.x += come * std::cos(robot_.pose().yaw);
    odometry->pose.pose.position.y += come * std::sin(robot_.pose().yaw);
    odometry->twist.twist.linear.x = speed;
  };
  for (int i = 0; i < 3; ++i) {
    come += 0.02;
    speed = i < 2 ? 0.3 : 0.0;
    robot_.wait(0.06);
    robot_.publishOdometry();
  }
  EXPECT_TRUE(eventually([&] { return controller_->computeVelocityCommands(velocity_) && velocity_.linear.x == 0.0; }))
      << velocity_.linear.x << " m/s";
}

TEST_F(ControllerTest, DoesNotDriveIntoWhatOnlyTheCostmapShows) {
  // The robot looks along x; the gap is 0.02 m, the margin 0.03 m.
  markInCostmap({0.2, -0.1}, {0.4, 0.1});
  ASSERT_TRUE(computeAt({}));
  EXPECT_EQ(velocity_.linear.x, 0.0);
  markInCostmap({}, {});
  ASSERT_TRUE(computeAt({}));
  EXPECT_GT(velocity_.linear.x, 0.0) << "cleared";
}

TEST_F(ControllerTest, SeesTheCostmapInItsOwnFrame) {
  useGlobalFrame("map");
  initialise();
  const Point2 ahead = toParentFrame(robot_.odometryInMap(), {0.3, 0.0});
  markInCostmap({ahead.x - 0.1, ahead.y - 0.1}, {ahead.x + 0.1, ahead.y + 0.1});
  ASSERT_TRUE(computeAt({}));
  EXPECT_EQ(velocity_.linear.x, 0.0);
}

TEST_F(ControllerTest, KeepsTheCostmapsFootprintAway) {
  // 0.25 m to the wall: 0.08 m before the circle of the parameter, and within the margin before a front at 0.23 m.
  robot_.range = [](double angle) { return static_cast<float>(0.15 / std::max(0.1, std::cos(angle))); };
  ASSERT_TRUE(computeAt({}));
  EXPECT_GT(velocity_.linear.x, 0.0);
  useFootprint({-0.05, -0.15}, {0.23, 0.15});
  initialise();
  ASSERT_TRUE(computeAt({}));
  EXPECT_EQ(velocity_.linear.x, 0.0);
  log_.flush();
  EXPECT_EQ(log_.count("SteeringController/footprint_radius is a circle of 0.17425 m, the footprint of the costmap"),
            1);
}

TEST_F(ControllerTest, AFootprintThatTheCircleHoldsChangesNothing) {
  useFootprint({-0.1, -0.1}, {0.1, 0.1});
  initialise();
  log_.flush();
  EXPECT_EQ(log_.count("the footprint of the costmap"), 0);
}

TEST_F(ControllerTest, TheCostmapCountsForNothingWhereItIsNotToBeUsed) {
  ros::param::set("~/SteeringController/use_costmap", false);
  initialise();
  markInCostmap({0.2, -0.1}, {0.4, 0.1});
  ASSERT_TRUE(computeAt({}));
  EXPECT_GT(velocity_.linear.x, 0.0);
}

TEST_F(ControllerTest, SaysNoOnceItHasStoodBeforeAnObstacleForLongerThanThePatience) {
  robot_.range = [](double angle) { return std::abs(angle) < 0.3 ? 0.0943F : 4.0F; };
  EXPECT_TRUE(eventually([&] {
    stand(0.1);
    return controller_->computeVelocityCommands(velocity_);
  })) << "it waits";
  expectStands("it has not got away from this place for longer than patience", [&] {
    for (int i = 0; i < 5; ++i) {  // a pause of more than 2 s would not count as standing there
      stand(1.0);
      controller_->setPlan(straightPlan("odom", robot_.pose(), 3.0));
      eventually([&] { return controller_->computeVelocityCommands(velocity_); }, 0.3);
    }
  });
}

TEST_F(ControllerTest, SaysThatAnObstacleStopsIt) {
  ros::param::set("~/SteeringController/patience", 0.0);
  initialise();
  DiagnosticsListener listener("SteeringController");
  robot_.range = [](double angle) { return std::abs(angle) < 0.3 ? 0.0943F : 4.0F; };
  const std::string reason = "the robot stands: an obstacle is within the safety margin";
  EXPECT_TRUE(eventually([&] {
    stand(0.5);
    controller_->setPlan(straightPlan("odom", robot_.pose(), 3.0));
    controller_->computeVelocityCommands(velocity_);
    return listener.latched().message.find(reason) == 0 && log_.count(reason) > 0;
  }));
  EXPECT_EQ(listener.latched().level, diagnostic_msgs::DiagnosticStatus::WARN);
}

TEST_F(ControllerTest, SaysThatTheRobotDoesNotDoWhatItIsTold) {
  ros::param::set("~/SteeringController/patience", 0.0);
  initialise();
  DiagnosticsListener listener("SteeringController");
  const auto steer = [&] {
    robot_.again();
    controller_->setPlan(straightPlan("odom", robot_.pose(), 3.0));
    controller_->computeVelocityCommands(velocity_);
  };
  const std::string reason = "the robot stands: it does not do what it is told";
  EXPECT_TRUE(eventually([&] {
    steer();
    return listener.latched().message == reason && log_.count(reason + ": for ") > 0;
  })) << listener.latched().message;
  EXPECT_EQ(listener.latched().level, diagnostic_msgs::DiagnosticStatus::WARN);
  EXPECT_TRUE(eventually([&] {
    robot_.moveTo({robot_.pose().x + 0.03, robot_.pose().y, robot_.pose().yaw}, 0.05);
    steer();
    return listener.latched().message == "it drives";
  })) << listener.latched().message;
}

/// Behind a velocity smoother that takes 0.7 s.
TEST_F(ControllerTest, SaysThatTheBaseTurnsLaterThanItIsToldTo) {
  constexpr double kStep = 0.05;  // s
  std::deque<double> on_their_way(14, 0.0);
  double turning = 0.0;
  robot_.alter_odometry = [&](nav_msgs::Odometry* odometry) { odometry->twist.twist.angular.z = turning; };
  Pose2 pose = robot_.pose();
  for (int i = 0; i < 800 && log_.count("the robot turns ") == 0; ++i) {
    robot_.moveTo(pose, kStep);
    controller_->setPlan(straightPlan("odom", {pose.x, pose.y, M_PI_2}, 3.0));
    ASSERT_TRUE(eventually([&] { return controller_->computeVelocityCommands(velocity_); }));
    on_their_way.push_back(velocity_.angular.z);
    turning = on_their_way.front();
    on_their_way.pop_front();
    pose.yaw = normalizeAngle(pose.yaw + turning * kStep);
  }
  // On a busy computer the controller hears of the last step only after it was asked.
  EXPECT_EQ(log_.count("the robot turns 0.7") + log_.count("the robot turns 0.80"), 1);
}

TEST_F(ControllerTest, YieldsToAPersonWhereScansHaveNoStamps) {
  DiagnosticsListener listener("SteeringController");
  double person = 3.0;  // m from the scanner to the middle of somebody straight ahead
  robot_.range = [&person](double angle) {
    constexpr double kRadius = 0.25;
    const double aside = person * std::sin(angle);
    if (std::abs(angle) > M_PI_4 || std::abs(aside) >= kRadius) return static_cast<float>(4.0 + angle);
    return static_cast<float>(person * std::cos(angle) - std::sqrt(kRadius * kRadius - aside * aside));
  };
  robot_.alter_scan = [](auto* scan) { scan->header.stamp = ros::Time(); };
  const std::string reason = "the robot stands: it yields to somebody who moves";
  bool stands = false;
  EXPECT_TRUE(eventually([&] {
    if (!stands) {
      person = person > 0.7 ? person - 0.04 : 3.0;  // comes at 0.8 m/s, again and again
      robot_.again();
    }
    controller_->setPlan(straightPlan("odom", robot_.pose(), 3.0));
    stands = controller_->computeVelocityCommands(velocity_) && velocity_.linear.x == 0.0;
    return stands && listener.latched().message.find(reason) == 0;
  }));
}

TEST_F(ControllerTest, TellsOfItsSensorsAndThatNobodyAsks) {
  DiagnosticsListener listener("SteeringController");
  EXPECT_TRUE(eventually([&] {
    robot_.again();
    return std::abs(
               std::atof(DiagnosticsListener::valueOf("rate (Hz)", listener.task("SteeringController scan")).c_str()) -
               20.0) < 0.1;
  }));
  EXPECT_TRUE(eventuallyInTime([&] { return listener.latched().message.find("nobody asks for commands") == 0; }));
  robot_.wait(1.0);
  EXPECT_TRUE(eventually([&] {
    return listener.task("SteeringController odometry").message.find("the newest message on /odom is ") == 0;
  }));
}

TEST_F(ControllerTest, SaysThatTheClockStandsStill) {
  DiagnosticsListener listener("SteeringController");
  const std::string text = "the clock stands still: the simulator or rosbag is paused, or has ended";
  const auto is_said = [&](const DiagnosticsListener::Status& status) {
    return status.message == text && status.level == diagnostic_msgs::DiagnosticStatus::WARN;
  };
  for (const char* task : {"SteeringController", "SteeringController scan", "SteeringController odometry"}) {
    EXPECT_TRUE(eventually([&] { return is_said(listener.task(task)); })) << task;
  }
  EXPECT_TRUE(is_said(listener.latched()));
  EXPECT_TRUE(eventuallyInTime([&] { return listener.latched().message.find("nobody asks for commands") == 0; }))
      << listener.latched().message;
}

TEST_F(ControllerTest, BadParametersLeaveItStanding) {
  ros::param::set("~/SteeringController/max_linear", -1.0);
  SteeringController controller;
  EXPECT_NO_THROW(controller.initialize("SteeringController", &tf_, costmap_.get()));
  log_.flush();
  EXPECT_EQ(log_.count("SteeringController cannot be used: parameter max_linear is -1"), 1);
  EXPECT_FALSE(controller.setPlan(straightPlan("odom", {}, 1.0)));
  EXPECT_FALSE(controller.computeVelocityCommands(velocity_));
  EXPECT_TRUE(stands());
  EXPECT_FALSE(controller.isGoalReached());
  EXPECT_NO_THROW(controller.initialize("SteeringController", nullptr, nullptr));
}

TEST_F(ControllerTest, LoadsByItsNameThroughPluginlib) {
  const std::string package = ros::package::getPath("nav_core").empty() ? "lstm_planner" : "nav_core";
  pluginlib::ClassLoader<nav_core::BaseLocalPlanner> loader(package, "nav_core::BaseLocalPlanner");
  const auto controller = loader.createInstance("lstm_planner/SteeringController");
  controller->initialize(loader.getName("lstm_planner/SteeringController"), &tf_, costmap_.get());
  EXPECT_TRUE(eventually([&] {
    robot_.again();
    controller->setPlan(straightPlan("odom", {}, 1.0));
    return controller->computeVelocityCommands(velocity_);
  }));
}

const RosProgram program("controller_plugin", &runTestsBesideSpinner);

}  // namespace
}  // namespace lstm_planner::controller_plugin
