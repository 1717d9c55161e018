#include "ros/recorder/dataset_recorder.hpp"

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/recorder/dataset_recorder_implementation.hpp"

namespace lstm_planner {

namespace {

// Five seconds of a fast scanner, and more of odometry: the disk may be slow at times.
constexpr int kScanQueue = 200;
constexpr int kOdometryQueue = 1000;
constexpr int kGoalQueue = 20;
const ros::WallDuration kStatusPeriod(1.0);
constexpr double kLongestDelay = 0.5;  // s that odometry is behind the clock, at the most

}  // namespace

DatasetRecorder::DatasetRecorder(const RecorderNodeParameters& parameters)
    : implementation_(std::make_unique<Implementation>(parameters)) {}

DatasetRecorder::~DatasetRecorder() = default;

int DatasetRecorder::run(const volatile std::sig_atomic_t& stop) { return implementation_->run(stop); }

DatasetRecorder::Implementation::Implementation(const RecorderNodeParameters& parameters)
    : parameters_(parameters),
      file_(parameters),
      progress_(parameters.recorder.action_angles.size()),
      tf_listener_(&tf_),
      messages_(tf_, parameters.base_frame, std::nullopt, parameters.recorder, &progress_),
      waypoints_(parameters.waypoints, parameters.seed),
      markers_(private_node_, parameters.recorder.action_angles) {
  goal_publisher_ = private_node_.advertise<geometry_msgs::PoseStamped>("goal", 10, true);
  diagnostics_publisher_ = node_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);

  // Without this, TCP holds a scan back until the one before is acknowledged: up to 40 ms.
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  subscribers_ = {node_.subscribe(parameters.scan_topic, kScanQueue, &Implementation::onScan, this, hints),
                  node_.subscribe(parameters.odom_topic, kOdometryQueue, &Implementation::onOdometry, this, hints),
                  node_.subscribe("move_base/goal", kGoalQueue, &Implementation::onActionGoal, this, hints),
                  node_.subscribe("move_base_simple/goal", kGoalQueue, &Implementation::onSimpleGoal, this, hints),
                  node_.subscribe("move_base/cancel", kGoalQueue, &Implementation::onCancel, this, hints),
                  node_.subscribe("move_base/result", kGoalQueue, &Implementation::onResult, this, hints)};
  services_ = {private_node_.advertiseService("pause", &Implementation::pause, this),
               private_node_.advertiseService("discard_episode", &Implementation::discardEpisode, this),
               private_node_.advertiseService("finish", &Implementation::finishByService, this)};
  timer_ = private_node_.createWallTimer(kStatusPeriod, &Implementation::onTimer, this);
}

int DatasetRecorder::Implementation::run(const volatile std::sig_atomic_t& stop) {
  while (ros::ok() && stop == 0 && !exit_code_) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
  }
  if (!exit_code_) finish();
  publishStatus();
  return *exit_code_;
}

void DatasetRecorder::Implementation::guarded(const std::function<void()>& work) {
  if (exit_code_) return;
  try {
    work();
  } catch (const std::exception& error) {
    problem_ = error.what();
    ROS_ERROR_THROTTLE(10.0, "%s", error.what());
  }
}

void DatasetRecorder::Implementation::onScan(const sensor_msgs::LaserScan::ConstPtr& scan) {
  guarded([&] {
    ++scans_heard_;
    last_scan_ = ros::WallTime::now();
    messages_.hear(*scan, ros::Time::now());
    afterSensing();
  });
}

void DatasetRecorder::Implementation::onOdometry(const nav_msgs::Odometry::ConstPtr& odometry) {
  if (!file_.isOpen() && !exit_code_) openFile(frameName(odometry->header.frame_id));
  guarded([&] {
    ++odometry_heard_;
    const ros::Time now = ros::Time::now();
    last_odometry_ = ros::WallTime::now();
    odometry_stamp_ = odometry->header.stamp.isZero() ? now : odometry->header.stamp;
    messages_.hear(*odometry, now);
    afterSensing();
  });
}

void DatasetRecorder::Implementation::openFile(const std::string& odometry_frame) {
  try {
    file_.open(odometry_frame, &progress_);
    ROS_INFO("recording into %s", file_.path().c_str());
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    exit_code_ = 1;
  }
}

void DatasetRecorder::Implementation::onActionGoal(const move_base_msgs::MoveBaseActionGoal::ConstPtr& goal) {
  guarded([&] {
    ++goals_heard_;
    messages_.hear(*goal, "move_base/goal", goalHeardNow());
  });
}

void DatasetRecorder::Implementation::onSimpleGoal(const geometry_msgs::PoseStamped::ConstPtr& goal) {
  guarded([&] {
    ++goals_heard_;
    messages_.hearGoal(*goal, "move_base_simple/goal", goalHeardNow());
  });
}

void DatasetRecorder::Implementation::onCancel(const actionlib_msgs::GoalID::ConstPtr& cancel) {
  guarded([&] {
    ++goals_heard_;
    messages_.hear(*cancel, ros::Time::now());
  });
}

void DatasetRecorder::Implementation::onResult(const move_base_msgs::MoveBaseActionResult::ConstPtr& result) {
  guarded([&] {
    ++goals_heard_;
    messages_.hear(*result, ros::Time::now());
  });
}

ros::Time DatasetRecorder::Implementation::goalHeardNow() {
  goal_stamp_ = odometry_stamp_;
  return ros::Time::now();
}

void DatasetRecorder::Implementation::afterSensing() {
  pickGoal();
  const DriveRecorder& recorder = messages_.recorder();
  if (recorder.situation()) {
    markers_.publish(messages_.odometryFrame(), *recorder.situation(), progress_, recorder.goal());
  }
}

void DatasetRecorder::Implementation::pickGoal() {
  const DriveRecorder& recorder = messages_.recorder();
  if (waypoints_.empty() || recorder.paused() || recorder.goal() || !file_.isOpen()) return;
  if (ros::Time::now().isZero()) return;  // a simulator's clock has not come yet
  // A goal that was heard is worked on only when everything before it is.
  const double since_goal = std::abs((odometry_stamp_ - goal_stamp_).toSec());
  if (!goal_stamp_.isZero() && since_goal <= parameters_.recorder.delay + kLongestDelay) return;

  const NamedPose& waypoint = waypoints_.next();
  geometry_msgs::PoseStamped goal;
  goal.header.frame_id = parameters_.waypoint_frame;
  goal.header.stamp = goalHeardNow();
  goal.pose = toMessage(waypoint.pose);
  goal_publisher_.publish(goal);
  messages_.hearGoal(goal, "waypoints", goal.header.stamp);
  ROS_INFO("the next goal is %s at (%.2f, %.2f)", waypoint.name.c_str(), waypoint.pose.x, waypoint.pose.y);
}

}  // namespace lstm_planner
