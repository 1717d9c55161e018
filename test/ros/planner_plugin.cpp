// The global planner under move_base: what comes in, what comes out, start and end. The clock stands still unless a test moves it.

#include <gtest/gtest.h>
#include <pluginlib/class_loader.hpp>
#include <ros/package.h>

#include <cmath>
#include <thread>

#include "ros/planner_fixture.hpp"

namespace lstm_planner {
namespace {

constexpr double kGoalTolerance = 1e-9;
const Pose2 kGoal{6.0, 1.0, 0.7};

double distance(const geometry_msgs::PoseStamped& a, const geometry_msgs::PoseStamped& b) {
  return distanceBetween(a.pose.position, b.pose.position);
}

TEST_F(PlannerTest, PlanEndsAtTheGoalWithItsHeading) {
  auto planner = makePlanner();
  ASSERT_TRUE(plan(planner.get(), stampedPose("odom", kGoal)));
  const Pose2 end = fromMessage(plan_.back().pose);
  EXPECT_NEAR(end.x, kGoal.x, kGoalTolerance);
  EXPECT_NEAR(end.y, kGoal.y, kGoalTolerance);
  EXPECT_NEAR(end.yaw, kGoal.yaw, kGoalTolerance);
}

TEST_F(PlannerTest, PlanStartsAtTheRobotAndIsDense) {
  auto planner = makePlanner();
  moveTo(planner.get(), {0.1, 0.05, 0.3}, 0.2);
  ASSERT_TRUE(plan(planner.get(), stampedPose("odom", kGoal)));
  EXPECT_LT(distance(plan_.front(), start()), 1e-6);
  for (std::size_t i = 1; i < plan_.size(); ++i) {
    // rollout/spacing is 0.05 m; move_base's controllers drop leading poses 1 m or more from the robot.
    EXPECT_LE(distance(plan_[i - 1], plan_[i]), 0.05 + 1e-9) << "at pose " << i;
  }
}

TEST_F(PlannerTest, EveryPoseIsStampedInTheGlobalFrameWithAUnitQuaternion) {
  useGlobalFrame("map");
  auto planner = makePlanner();
  ASSERT_TRUE(plan(planner.get(), stampedPose("map", kGoal)));
  for (const auto& pose : plan_) {
    EXPECT_EQ(pose.header.frame_id, "map");
    EXPECT_EQ(pose.header.stamp, ros::Time::now());
    const auto& q = pose.pose.orientation;
    EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1.0, 1e-9);
  }
  EXPECT_LT(distance(plan_.front(), start()), 1e-6) << "the robot's place in the map";
}

TEST_F(PlannerTest, GoalInAnotherFrameIsTransformed) {
  auto planner = makePlanner();
  ASSERT_TRUE(plan(planner.get(), stampedPose("map", kGoal)));
  const Pose2 end = compose(robot_.odometryInMap(), fromMessage(plan_.back().pose));
  EXPECT_EQ(plan_.back().header.frame_id, "odom");
  EXPECT_NEAR(end.x, kGoal.x, 1e-6);
  EXPECT_NEAR(end.y, kGoal.y, 1e-6);
  EXPECT_NEAR(end.yaw, kGoal.yaw, 1e-6);
}

TEST_F(PlannerTest, GoalInAnUnknownOrUnnamedFrameIsRefused) {
  auto planner = makePlanner();
  EXPECT_FALSE(plan(planner.get(), stampedPose("moon", kGoal)));
  EXPECT_TRUE(plan_.empty());
  EXPECT_FALSE(plan(planner.get(), stampedPose("", kGoal)));
}

TEST_F(PlannerTest, StartInAnotherFrameOrFarFromTheRobotIsRefused) {
  auto planner = makePlanner();
  EXPECT_FALSE(planner->makePlan(stampedPose("map", {}), stampedPose("odom", kGoal), plan_));
  EXPECT_FALSE(planner->makePlan(stampedPose("odom", {3.0, 0.0, 0.0}), stampedPose("odom", kGoal), plan_));
}

TEST_F(PlannerTest, GoalFarOutsideARollingCostmapIsAccepted) {
  auto planner = makePlanner();
  ASSERT_TRUE(plan(planner.get(), stampedPose("odom", {500.0, -300.0, 0.0})));
  EXPECT_NEAR(plan_.back().pose.position.x, 500.0, kGoalTolerance);
}

TEST_F(PlannerTest, GoalThatIsNotFiniteIsRefusedAndAZeroQuaternionMeansHeadingZero) {
  auto planner = makePlanner();
  EXPECT_FALSE(plan(planner.get(), stampedPose("odom", {std::nan(""), 0.0, 0.0})));
  auto goal = stampedPose("odom", kGoal);
  goal.pose.orientation = geometry_msgs::Quaternion();
  ASSERT_TRUE(plan(planner.get(), goal));
  EXPECT_EQ(plan_.back().pose.orientation.w, 1.0);
}

TEST_F(PlannerTest, SecondsWithoutSensorsAreNotWaitedFor) {
  LstmGlobalPlanner planner;
  planner.initialize("LstmGlobalPlanner", costmap_.get());
  robot_.wait(10.0);
  const ros::WallTime before = ros::WallTime::now();
  EXPECT_FALSE(plan(&planner, stampedPose("odom", kGoal)));
  EXPECT_LT((ros::WallTime::now() - before).toSec(), 0.1) << "move_base's costmap is locked meanwhile";
}

TEST_F(PlannerTest, OldScanOrOdometryGivesNoPlanUntilTheyReturn) {
  auto planner = makePlanner();
  robot_.wait(0.6);
  EXPECT_FALSE(preview(planner.get())) << "scan_timeout and odom_timeout are 0.5 s";
  robot_.publishScan();
  EXPECT_FALSE(preview(planner.get())) << "the odometry is still old";
  moveTo(planner.get(), robot_.pose(), 0.1);
}

TEST_F(PlannerTest, OdometryThatIsNotFiniteGivesNoPlan) {
  auto planner = makePlanner();
  robot_.moveTo({std::nan(""), 0.0, 0.0}, 0.1);
  EXPECT_TRUE(eventually([&] {
    return !planner->makePlan(stampedPose("odom", {}), stampedPose("odom", kGoal), plan_);
  }));
}

TEST_F(PlannerTest, ScanNarrowerThanTheSectorsGivesNoPlan) {
  auto planner = makePlanner();
  robot_.scan_span = M_PI_2;
  EXPECT_TRUE(eventually([&] {
    robot_.again();
    return !preview(planner.get());
  }));
}

TEST_F(PlannerTest, ScannerThatReachesLessThanHalfTheRangeCapGivesNoPlan) {
  auto planner = makePlanner();
  robot_.range_max = 2.0;  // the model's range cap is 6 m
  EXPECT_TRUE(eventually([&] {
    robot_.again();
    return !preview(planner.get());
  }));
}

TEST_F(PlannerTest, ScannerUpsideDownSeesTheSame) {
  DecisionListener decisions("LstmGlobalPlanner");
  auto planner = makePlanner();
  const auto goal = stampedPose("odom", kGoal);
  announce(goal, planner.get(), &decisions);
  const auto upright = decisions.newest();

  robot_.placeScanner("turned_laser", {0.1, 0.0, 0.0}, true);
  robot_.scan_frame = "turned_laser";
  robot_.range = [range = robot_.range](double angle) { return range(-angle); };
  planner = makePlanner();
  announce(goal, planner.get(), &decisions);
  EXPECT_EQ(decisions.newest().at("preferences"), upright.at("preferences"));
}

TEST_F(PlannerTest, TwoThreadsMayAskAtOnce) {
  auto planner = makePlanner();
  const auto ask = [&](double y, int* plans) {
    Plan plan;
    for (int i = 0; i < 200; ++i) {
      *plans += planner->makePlan(start(), stampedPose("odom", {5.0, y + i, 0.0}), plan);
    }
  };
  int first = 0;
  int second = 0;
  std::thread other([&] { ask(0.0, &first); });
  ask(1000.0, &second);
  other.join();
  EXPECT_EQ(first, 200);
  EXPECT_EQ(second, 200);
}

TEST_F(PlannerTest, MissingOrDamagedModelRefusesEveryPlanAndThrowsNothing) {
  model_.truncate();
  LstmGlobalPlanner damaged;
  EXPECT_NO_THROW(damaged.initialize("LstmGlobalPlanner", costmap_.get()));
  EXPECT_FALSE(plan(&damaged, stampedPose("odom", kGoal)));

  for (const char* path : {"/no/such/model.onnx", "package://no_such_package/model.onnx", ""}) {
    ros::param::set("~/LstmGlobalPlanner/model", path);
    LstmGlobalPlanner missing;
    EXPECT_NO_THROW(missing.initialize("LstmGlobalPlanner", costmap_.get())) << path;
    EXPECT_FALSE(plan(&missing, stampedPose("odom", kGoal))) << path;
  }
}

TEST_F(PlannerTest, ModelForASmallerRobotOrAnotherStepIsRefused) {
  for (const char* name : {"shield/footprint_radius", "step/length"}) {
    ros::param::set(std::string("~/LstmGlobalPlanner/") + name, 0.6);
    LstmGlobalPlanner planner;
    EXPECT_NO_THROW(planner.initialize("LstmGlobalPlanner", costmap_.get()));
    robot_.again();
    EXPECT_FALSE(preview(&planner)) << name;
    ros::param::del(std::string("~/LstmGlobalPlanner/") + name);
  }
}

TEST_F(PlannerTest, PlansOnlyAfterInitializeAndASecondInitializeChangesNothing) {
  LstmGlobalPlanner planner;
  EXPECT_FALSE(plan(&planner, stampedPose("odom", kGoal)));
  EXPECT_NO_THROW(planner.initialize("LstmGlobalPlanner", nullptr));
  EXPECT_FALSE(plan(&planner, stampedPose("odom", kGoal)));

  auto initialised = makePlanner();
  EXPECT_NO_THROW(initialised->initialize("LstmGlobalPlanner", costmap_.get()));
  EXPECT_TRUE(preview(initialised.get()));
}

TEST_F(PlannerTest, OutlivesTheCostmap) {
  auto planner = makePlanner();
  const auto robot = start();
  costmap_.reset();
  EXPECT_TRUE(planner->makePlan(robot, stampedPose("odom", kGoal), plan_));
  EXPECT_NO_THROW(planner.reset());
}

TEST_F(PlannerTest, PlannerFrequencyOfZeroIsWarnedOfOnce) {
  LogListener log;
  makePlanner();
  log.flush();
  EXPECT_EQ(log.count("planner_frequency"), 0);
  ros::param::del("~/planner_frequency");  // move_base's default is 0
  makePlanner();
  log.flush();
  EXPECT_EQ(log.count("planner_frequency is 0"), 1);
}

TEST_F(PlannerTest, PlannerThatFailsInATightLoopSaysSoOnce) {
  LogListener log;
  auto planner = makePlanner();
  robot_.wait(1000.0);
  log.flush();
  const int before = log.count("no plan");
  for (int i = 0; i < 500; ++i) {
    EXPECT_FALSE(preview(planner.get()));
  }
  log.flush();
  EXPECT_EQ(log.count("no plan"), before + 1);
}

TEST_F(PlannerTest, LoadsByItsNameThroughPluginlib) {
  const std::string package = ros::package::getPath("nav_core").empty() ? "lstm_planner" : "nav_core";
  pluginlib::ClassLoader<nav_core::BaseGlobalPlanner> loader(package, "nav_core::BaseGlobalPlanner");
  ASSERT_TRUE(loader.isClassAvailable("lstm_planner/LstmGlobalPlanner"));
  EXPECT_EQ(loader.getName("lstm_planner/LstmGlobalPlanner"), "LstmGlobalPlanner");
  const auto planner = loader.createInstance("lstm_planner/LstmGlobalPlanner");
  planner->initialize("LstmGlobalPlanner", costmap_.get());
  EXPECT_TRUE(eventually([&] {
    robot_.again();
    return planner->makePlan(start(), stampedPose("odom", kGoal), plan_);
  }));
}

}  // namespace
}  // namespace lstm_planner

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "planner_plugin");
  const ros::NodeHandle node_handle;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
