// The global planner under move_base: what comes in, what comes out, start and end. The clock stands still unless a
// test moves it.

#include <actionlib/TestActionResult.h>
#include <gtest/gtest.h>
#include <nav_msgs/Path.h>
#include <ros/package.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <pluginlib/class_loader.hpp>
#include <set>
#include <string>
#include <thread>

#include "ros/fixtures/diagnostics_listener.hpp"
#include "ros/fixtures/planner_fixture.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::planner_plugin {
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
  expectNoPlan(planner.get(), stampedPose("moon", kGoal), "no transform from moon to odom");
  expectNoPlan(planner.get(), stampedPose("", kGoal), "the goal names no frame");
}

TEST_F(PlannerTest, StartInAnotherFrameOrFarFromTheRobotIsRefused) {
  auto planner = makePlanner();
  const auto expectRefusedFrom = [&](const geometry_msgs::PoseStamped& start, const std::string& reason) {
    log_.expectRefusal([&] { return planner->makePlan(start, stampedPose("odom", kGoal), plan_); }, reason,
                       [&] { stand(kLogPeriod); });
  };
  expectRefusedFrom(stampedPose("map", {}), "no plan: the start is in frame 'map', expected odom");
  expectRefusedFrom(stampedPose("odom", {3.0, 0.0, 0.0}), "no plan: the start is 3.00 m from the robot (/odom), ");
}

TEST_F(PlannerTest, GoalFarOutsideARollingCostmapIsAccepted) {
  auto planner = makePlanner();
  ASSERT_TRUE(plan(planner.get(), stampedPose("odom", {500.0, -300.0, 0.0})));
  EXPECT_NEAR(plan_.back().pose.position.x, 500.0, kGoalTolerance);
}

TEST_F(PlannerTest, GoalThatIsNotFiniteIsRefusedAndAZeroQuaternionMeansHeadingZero) {
  auto planner = makePlanner();
  expectNoPlan(planner.get(), stampedPose("odom", {std::nan(""), 0.0, 0.0}), "the goal's pose is not finite");
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
  log_.flush();
  EXPECT_EQ(log_.count("no plan: no scan has been received on /scan"), 1);
}

TEST_F(PlannerTest, OldScanOrOdometryGivesNoPlanUntilTheyReturn) {
  auto planner = makePlanner();
  const auto ask = [&] { return preview(planner.get()); };
  // Three periods of 0.05 s are less than the shortest timeouts, 0.5 s.
  const auto wait = [&] {
    stand(kLogPeriod);
    robot_.wait(0.6);
  };
  log_.expectRefusal(ask, "no plan: the newest message on /scan is 0.6", wait);
  log_.expectRefusal(ask, "no plan: the newest message on /odom is 0.6", [&] {
    wait();
    robot_.publishScan();
  });
  moveTo(planner.get(), robot_.pose(), 0.1);
}

TEST_F(PlannerTest, OdometryThatIsNotFiniteGivesNoPlan) {
  auto planner = makePlanner();
  log_.expectRefusal([&] { return planner->makePlan(stampedPose("odom", {}), stampedPose("odom", kGoal), plan_); },
                     "no plan: the odometry on /odom has a pose or twist that is not finite",
                     [&] {
                       robot_.moveTo({std::nan(""), 0.0, 0.0}, kLogPeriod);
                     });
}

TEST_F(PlannerTest, GoalThatIsTooFarAwayGivesNoPlan) {
  auto planner = makePlanner();
  expectNoPlan(planner.get(), stampedPose("odom", {100e3, 0.0, 0.0}),
               "the goal is 100000 m from the robot, expected at most 10000 m");
}

TEST_F(PlannerTest, TfOfAnotherOdometryThanTheTopicsIsWarnedOf) {
  const std::string warning = "tf has the pose of another odometry";
  double ahead = 0.0;  // m, of tf
  auto planner = makePlanner();
  robot_.alter_odometry = [&](nav_msgs::Odometry* odometry) { odometry->pose.pose.position.x += ahead; };
  const auto drive = [&](double speed, double seconds) {
    constexpr double kInterval = 0.05;  // s
    for (double time = 0.0; time < seconds; time += kInterval) {
      const Pose2 pose{robot_.pose().x + speed * kInterval, 0.0, 0.0};
      robot_.moveTo(pose, kInterval);
      EXPECT_TRUE(eventually(
          [&] { return preview(planner.get()) && std::abs(plan_.front().pose.position.x - pose.x - ahead) < 1e-6; }));
    }
  };
  constexpr double kFullSpeed = 2.0;  // m/s
  ahead = 0.1 * kFullSpeed;           // tf is 0.1 s old
  drive(kFullSpeed, 3.0);
  log_.flush();
  EXPECT_EQ(log_.count(warning), 0);
  ahead = 0.3;
  drive(0.0, 3.0);
  log_.flush();
  EXPECT_EQ(log_.count(warning), 1);
}

TEST_F(PlannerTest, ScansThatStayTheSameWhileTheOdometryGoesOnGiveNoPlanUntilANewGoal) {
  ros::param::set("~/LstmGlobalPlanner/correct_drift", true);
  DecisionListener decisions("LstmGlobalPlanner");
  auto planner = makePlanner();
  const auto goal = stampedPose("odom", kGoal);
  announce(goal, planner.get(), &decisions);
  for (int i = 0; i < 6; ++i) moveTo(planner.get(), {robot_.pose().x + 0.2, 0.0, 0.0}, 0.5);
  log_.expectRefusal([&] { return plan(planner.get(), goal); },
                     "no plan: by /odom the robot has moved by 1.2 m (or rad), by the scans it stands",
                     [&] { stand(kLogPeriod); });
  const auto elsewhere = stampedPose("odom", {kGoal.x, kGoal.y + 1.0, 0.0});
  announce(elsewhere, planner.get(), &decisions);
  EXPECT_TRUE(plan(planner.get(), elsewhere));
}

TEST_F(PlannerTest, ScanNarrowerThanTheSectorsGivesNoPlan) {
  auto planner = makePlanner();
  robot_.scan_span = M_PI_2;
  expectNoPlan(planner.get(), stampedPose("odom", kGoal), "the scan covers -45");
}

TEST_F(PlannerTest, AScannerThatIsTooShortForTheNetworkIsLedByTheRouteAndOneLineSaysSo) {
  ros::param::set("~/LstmGlobalPlanner/leader", "network");
  robot_.range_max = 2.0;  // the model's range cap is 6 m
  robot_.range = [](double) { return 1.9F; };
  DecisionListener decisions("LstmGlobalPlanner");
  auto planner = makePlanner();
  const auto goal = stampedPose("odom", kGoal);
  announce(goal, planner.get(), &decisions);
  EXPECT_EQ(decisions.newest().at("leader"), "route");
  moveTo(planner.get(), {0.1, 0.0, 0.0}, 2.0 * kLogPeriod);
  log_.flush();
  EXPECT_EQ(log_.count("the scanner reaches 2 m*the path through the remembered obstacles leads in its place"), 1);
}

TEST_F(PlannerTest, AModelIsNeededOnlyToLead) {
  ros::param::set("~/LstmGlobalPlanner/leader", "route");
  ros::param::set("~/LstmGlobalPlanner/model", "/no/such/model.onnx");
  auto planner = makePlanner();
  ASSERT_TRUE(planner);
  EXPECT_TRUE(plan(planner.get(), stampedPose("odom", kGoal)));
  EXPECT_TRUE(
      log_.eventuallyHas("no network can lead, only the route: model file /no/such/model.onnx: it cannot be read"));
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

TEST_F(PlannerTest, PlanAndMarkersAreThoseOfTheDrivenGoalAndNotOfAQuestion) {
  std::mutex mutex;
  nav_msgs::Path path;
  int paths_to_elsewhere = 0;
  std::map<std::string, int> markers;
  CallbackThread callbacks;
  const auto onPath = [&](const nav_msgs::Path::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex);
    path = *message;
    paths_to_elsewhere += distanceBetween(kGoal, path.poses.back().pose.position) > kGoalTolerance ? 1 : 0;
  };
  const auto onMarkers = [&](const visualization_msgs::MarkerArray::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex);
    markers.clear();
    for (const auto& marker : message->markers) ++markers[marker.ns];
  };
  ros::NodeHandle node_handle = callbacks.nodeHandle("~/LstmGlobalPlanner");
  const ros::Subscriber paths = node_handle.subscribe<nav_msgs::Path>("plan", 10, onPath);
  const ros::Subscriber arrays = node_handle.subscribe<visualization_msgs::MarkerArray>("markers", 10, onMarkers);
  DecisionListener decisions("LstmGlobalPlanner");
  auto planner = makePlanner();
  ASSERT_TRUE(eventually([&] { return paths.getNumPublishers() > 0 && arrays.getNumPublishers() > 0; }));
  const auto goal = stampedPose("odom", kGoal);
  announce(goal, planner.get(), &decisions);
  plan(planner.get(), stampedPose("odom", {-3.0, 2.0, 0.0}));

  moveTo(planner.get(), {0.1, 0.0, 0.0}, 0.2);
  ASSERT_TRUE(plan(planner.get(), goal));
  const auto same = [](const geometry_msgs::PoseStamped& a, const geometry_msgs::PoseStamped& b) {
    return a.header.frame_id == b.header.frame_id && a.header.stamp == b.header.stamp && distance(a, b) == 0.0;
  };
  EXPECT_TRUE(eventually([&] {
    const std::lock_guard<std::mutex> lock(mutex);
    return std::equal(path.poses.begin(), path.poses.end(), plan_.begin(), plan_.end(), same);
  }));
  const std::lock_guard<std::mutex> lock(mutex);
  EXPECT_EQ(path.header.frame_id, "odom");
  EXPECT_EQ(paths_to_elsewhere, 0);
  EXPECT_EQ(markers["preferences"], 5);
  for (const char* name : {"sectors", "waypoint", "trace", "goal"}) EXPECT_GE(markers[name], 1) << name;
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

TEST_F(PlannerTest, MissingOrDamagedModelThatIsToLeadRefusesEveryPlanAndThrowsNothing) {
  ros::param::set("~/LstmGlobalPlanner/leader", "network");
  model_.truncate();
  expectUnusable(model_.path() + ": ");
  for (const char* path : {"/no/such/model.onnx", "package://no_such_package/model.onnx"}) {
    ros::param::set("~/LstmGlobalPlanner/model", path);
    expectUnusable(path);
  }
  ros::param::set("~/LstmGlobalPlanner/model", "");
  expectUnusable("model");
}

TEST_F(PlannerTest, PlansAroundWhatOnlyTheCostmapShows) {
  ros::param::set("~/LstmGlobalPlanner/leader", "route");
  auto planner = makePlanner();
  const auto goal = stampedPose("odom", {3.0, 0.0, 0.0});
  const auto nearest = [&](const Point2& place) {
    double distance = 100.0;
    for (const auto& pose : plan_) distance = std::min(distance, distanceBetween(place, pose.pose.position));
    return distance;
  };
  robot_.range = [](double) { return 8.0F; };
  moveTo(planner.get(), {}, 0.1);
  ASSERT_TRUE(plan(planner.get(), goal));
  EXPECT_LT(nearest({1.5, 0.0}), 0.05);
  markInCostmap({1.4, -0.3}, {1.6, 0.3});
  ASSERT_TRUE(plan(planner.get(), goal));
  EXPECT_GT(nearest({1.5, 0.0}), 0.4) << "0.3 m of the zone and some of the footprint";
  markInCostmap({}, {});
  moveTo(planner.get(), {0.2, 0.3, 0.0}, 2.0);  // a step
  ASSERT_TRUE(plan(planner.get(), goal));
  EXPECT_LT(nearest({1.5, 0.15}), 0.1) << "cleared: straight to the goal";
}

TEST_F(PlannerTest, TheFootprintOfTheCostmapCountsWhereItReachesFarther) {
  useFootprint({-0.4, -0.3}, {0.1, 0.3});
  EXPECT_NE(makePlanner(), nullptr);
  log_.flush();
  EXPECT_EQ(
      log_.count("LstmGlobalPlanner/shield/footprint_radius is a circle of 0.17425 m, the footprint of the costmap"),
      1);
  EXPECT_EQ(log_.count("reaches 0.326 m beyond that: [["), 1);  // the corner at (-0.4, -0.3)
}

TEST_F(PlannerTest, TheRadiusOfTheCostmapsParametersCountsToo) {
  ros::param::set("~/costmap/robot_radius", 0.35);
  EXPECT_NE(makePlanner(), nullptr);
  log_.flush();
  EXPECT_EQ(log_.count("reaches 0.176 m beyond that: a circle of 0.35 m counts"), 1);
  ros::param::set("~/costmap/robot_radius", "wide");
  expectUnusable("costmap/robot_radius is wide, expected a positive number");
  ros::param::del("~/costmap/robot_radius");
}

TEST_F(PlannerTest, AFootprintMayBeAListOfCorners) {
  ros::NodeHandle node("~/LstmGlobalPlanner/shield");
  XmlRpc::XmlRpcValue corners;
  const double list[4][2] = {{0.25, 0.2}, {0.25, -0.2}, {-0.25, -0.2}, {-0.25, 0.2}};
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 2; ++k) corners[i][k] = list[i][k];
  }
  node.setParam("footprint", corners);
  auto planner = makePlanner();
  const auto goal = stampedPose("odom", kGoal);
  std::vector<geometry_msgs::PoseStamped> plan;
  robot_.again();
  EXPECT_TRUE(planner->makePlan(stampedPose("odom", {}), goal, plan));
}

TEST_F(PlannerTest, AFootprintThatIsNoneIsRefused) {
  ros::param::set("~/LstmGlobalPlanner/shield/footprint", "[[0.25, 0.2], [0.25, -0.2]]");
  expectUnusable("parameter shield/footprint is '[[0.25, 0.2], [0.25, -0.2]]': expected at least three corners");
}

TEST_F(PlannerTest, ModelForASmallerRobotIsUsedWithAWarning) {
  ros::param::set("~/LstmGlobalPlanner/shield/footprint_radius", 0.5);
  EXPECT_NE(makePlanner(), nullptr);
  log_.flush();
  EXPECT_EQ(log_.count("this robot's is 0.5 m"), 1);
}

TEST_F(PlannerTest, ARobotOfAnotherSizeNeedsNoOtherMemory) {
  ros::param::set("~/LstmGlobalPlanner/shield/footprint_radius", 0.105);  // a TurtleBot3 Burger, all else as shipped
  EXPECT_NE(makePlanner(), nullptr);
}

TEST_F(PlannerTest, ModelForAnotherStepIsRefused) {
  ros::param::set("~/LstmGlobalPlanner/step/length", 0.6);
  expectUnusable("step/length is 0.6 m");
}

TEST_F(PlannerTest, PlansOnlyAfterInitializeAndASecondInitializeChangesNothing) {
  LstmGlobalPlanner planner;
  expectNoPlan(&planner, stampedPose("odom", kGoal), "the planner cannot be used: initialize() has not been called");
  EXPECT_NO_THROW(planner.initialize("LstmGlobalPlanner", nullptr));
  EXPECT_FALSE(plan(&planner, stampedPose("odom", kGoal)));

  auto initialised = makePlanner();
  EXPECT_NO_THROW(initialised->initialize("LstmGlobalPlanner", costmap_.get()));
  EXPECT_TRUE(preview(initialised.get()));
  log_.flush();
  EXPECT_EQ(log_.count("LstmGlobalPlanner cannot be used: it was initialised without a costmap"), 1);
  EXPECT_EQ(log_.count("LstmGlobalPlanner is already initialised"), 1);
}

TEST_F(PlannerTest, MayBeUnloadedAfterTheCostmap) {
  auto planner = makePlanner();
  EXPECT_TRUE(planner->makePlan(start(), stampedPose("odom", kGoal), plan_));
  costmap_.reset();
  EXPECT_NO_THROW(planner.reset()) << "the address sanitizer sees whether it used the costmap";
}

TEST_F(PlannerTest, PlannerFrequencyOfZeroIsWarnedOfOnce) {
  makePlanner();
  log_.flush();
  EXPECT_EQ(log_.count("planner_frequency"), 0);
  ros::param::del("~/planner_frequency");  // move_base's default is 0
  makePlanner();
  log_.flush();
  EXPECT_EQ(log_.count("planner_frequency is 0"), 1);
}

TEST_F(PlannerTest, PlannerThatFailsInATightLoopSaysSoOnce) {
  auto planner = makePlanner();
  robot_.wait(1000.0);
  log_.flush();
  const int before = log_.count("no plan");
  for (int i = 0; i < 500; ++i) {
    EXPECT_FALSE(preview(planner.get()));
  }
  log_.flush();
  EXPECT_EQ(log_.count("no plan"), before + 1);
}

TEST_F(PlannerTest, TellsInDiagnosticsWhoLeadsAndWithWhichModel) {
  DiagnosticsListener listener("LstmGlobalPlanner");
  auto planner = makePlanner();
  EXPECT_TRUE(eventuallyInTime([&] {
    plan(planner.get(), stampedPose("odom", kGoal));
    return !DiagnosticsListener::valueOf("step", listener.task("LstmGlobalPlanner")).empty();
  }));
  EXPECT_TRUE(eventuallyInTime([&] { return listener.latched().message.find("the network leads: ") == 0; }))
      << listener.latched().message;
  std::set<std::string> latched;
  for (const auto& value : listener.latched().values) latched.insert(value.key);
  EXPECT_EQ(latched, std::set<std::string>{"model"}) << "what is latched has no figures, which would grow old";
  EXPECT_TRUE(eventually([&] { return listener.task("LstmGlobalPlanner model").message == model_.path(); }));
}

/// The results of all actions begin alike: those of move_base_flex are heard without its messages.
TEST_F(PlannerTest, HearsTheEndOfADriveFromMoveBaseAndFromMoveBaseFlex) {
  for (const char* topic : {"move_base/result", "~exe_path/result"}) {
    robot_.moveTo({}, 10.0);
    DiagnosticsListener listener("LstmGlobalPlanner");
    DecisionListener decisions("LstmGlobalPlanner");
    auto planner = makePlanner();
    const auto goal = stampedPose("odom", {1.0, 0.0, 0.0});
    announce(goal, planner.get(), &decisions);
    moveTo(planner.get(), {0.5, 0.0, 0.0}, 1.0);
    decide(planner.get(), goal, &decisions);
    const auto results = ros::NodeHandle().advertise<actionlib::TestActionResult>(ros::names::resolve(topic), 1);
    ASSERT_TRUE(eventually([&] { return results.getNumSubscribers() > 0; })) << topic;
    actionlib::TestActionResult result;
    result.status.status = actionlib_msgs::GoalStatus::SUCCEEDED;
    results.publish(result);
    EXPECT_TRUE(eventuallyInTime([&] {
      return listener.latched().message ==
             "nobody asks for plans: there is no goal; the last drive stopped 0.50 m from the goal";
    })) << topic
        << ": " << listener.latched().message;
    robot_.wait(1000.0);
    EXPECT_TRUE(eventuallyInTime([&] {
      EXPECT_FALSE(preview(planner.get()));
      return listener.latched().message == "no plan";
    })) << "a new goal, and no scans: "
        << listener.latched().message;
  }
}

TEST_F(PlannerTest, APlanThatSomebodyAsksForTellsNothingOfTheDrive) {
  DiagnosticsListener listener("LstmGlobalPlanner");
  auto planner = makePlanner();
  EXPECT_TRUE(eventuallyInTime([&] {
    EXPECT_TRUE(preview(planner.get()));
    return listener.latched().message == "nobody asks for plans: there is no goal";
  })) << listener.latched().message;
}

TEST_F(PlannerTest, AGoalWhoseEndWasNotHeardIsNotSaidToBeNone) {
  DiagnosticsListener listener("LstmGlobalPlanner");
  DecisionListener decisions("LstmGlobalPlanner");
  auto planner = makePlanner();
  announce(stampedPose("odom", kGoal), planner.get(), &decisions);
  const auto is_unasked = [&] { return listener.latched().message.find("nobody asks for plans") == 0; };
  EXPECT_TRUE(eventuallyInTime(is_unasked) || eventuallyInTime(is_unasked)) << listener.latched().message;
  EXPECT_EQ(
      listener.latched().message,
      "nobody asks for plans, but no end of the drive was heard: the goal was cancelled or given up, or move_base "
      "waits (see its log)");
}

TEST_F(PlannerTest, TellsInDiagnosticsWhyThereIsNoPlan) {
  DiagnosticsListener listener("LstmGlobalPlanner");
  auto planner = makePlanner();
  const auto expect_why = [&](const std::string& why) {
    EXPECT_TRUE(eventuallyInTime([&] {
      EXPECT_FALSE(preview(planner.get()));
      return DiagnosticsListener::valueOf("why", listener.latched()).find(why) == 0;
    })) << DiagnosticsListener::valueOf("why", listener.latched());
    EXPECT_EQ(listener.latched().message, "no plan");
  };
  robot_.wait(1000.0);
  expect_why("the newest message on /scan is ");
  robot_.alter_scan = [](auto* scan) { scan->angle_increment = 0.0F; };
  robot_.again();
  expect_why("the scan has angle_min");
  EXPECT_EQ(DiagnosticsListener::valueOf("step", listener.task("LstmGlobalPlanner")), "") << "nothing was decided";
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

const RosProgram program("planner_plugin", &runTestsBesideSpinner);

}  // namespace
}  // namespace lstm_planner::planner_plugin
