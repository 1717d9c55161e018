#include "ros/create2_stub/create2_stub.hpp"

#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <ros/callback_queue.h>
#include <std_msgs/UInt32.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/common/words.hpp"
#include "lstm_planner/ros/common/conversions.hpp"

namespace lstm_planner {
namespace {

constexpr std::uint64_t kStep = 5'000'000;  // ns of physics at a time
constexpr double kStepSeconds = 1e-9 * kStep;
constexpr double kEncoderRate = 1.0 / 0.015;            // Hz, the base sends its sensors every 15 ms
constexpr double kClockRate = 100.0;                    // Hz
constexpr std::uint64_t kClockStart = 100'000'000'000;  // ns; later than any buffer or time-out reaches back from
constexpr std::uint64_t kLongestGap = 1'000'000'000;    // ns that are made up for when the node was held up
constexpr double kStaleReport = 10.0;                   // s between two warnings

}  // namespace

Create2Stub::Create2Stub(const Create2StubParameters& parameters)
    : parameters_(parameters),
      building_(makeWorld(parameters)),
      world_(*building_, footprintOf(parameters.robot).circumscribedRadius()),
      robot_(world_, parameters.robot, parameters.start, parameters.seed),
      scanner_(parameters.laser, parameters.seed + 1, parameters.laser_frame, "scan"),
      driver_(parameters, &robot_, [this] { return driverTime(); }),
      localiser_(parameters.start, parameters.localisation_jump),
      driver_loop_(parameters.loop_hz),
      encoders_(kEncoderRate),
      clock_(kClockRate) {
  const bool sim_time = node_.param("/use_sim_time", false);
  if (parameters_.publish_clock && !sim_time) {
    throw std::invalid_argument(
        "parameter " + private_node_.resolveName("publish_clock") +
        " is true but /use_sim_time is not: set it before any node starts, or the others run on another clock");
  }
  if (parameters_.has_second_laser) {
    second_scanner_.emplace(parameters_.second_laser, parameters_.seed + 2, parameters_.second_laser_frame,
                            "second_scan");
  }
  truth_publisher_ = private_node_.advertise<nav_msgs::Odometry>("ground_truth", 100);
  contacts_publisher_ = private_node_.advertise<std_msgs::UInt32>("contacts", 10, true);
  jump_service_ = private_node_.advertiseService("jump_odometry", &Create2Stub::jumpOdometry, this);
  if (parameters_.publish_clock && parameters_.command_period > 0.0) {
    command_subscriber_ = node_.subscribe("cmd_vel", 10, &Create2Stub::onCommand, this);
  }
  if (parameters_.publish_clock) clock_publisher_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  watchOthers();
  publishContacts();
}

void Create2Stub::watchOthers() {
  for (const std::string& topic : wordsOf(parameters_.others)) {
    const auto move = [this, robot = other_subscribers_.size()](const nav_msgs::Odometry::ConstPtr& truth) {
      world_.moveRobot(robot, {truth->pose.pose.position.x, truth->pose.pose.position.y});
    };
    other_subscribers_.push_back(node_.subscribe<nav_msgs::Odometry>(topic, 1, move));
  }
}

void Create2Stub::run() {
  if (parameters_.publish_clock) {
    runOwnClock();
  } else {
    runGivenClock();
  }
}

void Create2Stub::runOwnClock() {
  const ros::WallDuration step(kStepSeconds / parameters_.real_time_factor);
  const ros::WallDuration longest_delay(0.1);
  time_ = kClockStart;
  restartAt(simulatedTime());
  ros::WallTime next = ros::WallTime::now();
  while (ros::ok()) {
    ros::spinOnce();
    waitForCommand();
    advance();
    next += step;
    // Time that was lost is not made up for: the others would be flooded.
    if (ros::WallTime::now() - next > longest_delay) next = ros::WallTime::now();
    ros::WallTime::sleepUntil(next);
  }
}

void Create2Stub::waitForCommand() {
  const auto period = static_cast<std::uint64_t>(1e9 * parameters_.command_period);
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(parameters_.command_patience);
  while (controlled_ && time_ >= command_time_ + period && ros::ok()) {
    // A controller that has ended its work says nothing any more; it is waited for once.
    controlled_ = ros::WallTime::now() < deadline;
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.005));
  }
}

void Create2Stub::onCommand(const geometry_msgs::Twist::ConstPtr& command) {
  // To stand still is the last thing that most say before they fall silent.
  controlled_ = command->linear.x != 0.0 || command->angular.z != 0.0;
  command_time_ = time_;
}

void Create2Stub::runGivenClock() {
  bool started = false;
  while (ros::ok()) {
    ros::spinOnce();
    const std::uint64_t now = ros::Time::now().toNSec();
    if (now == 0) {
      // The first message of a simulator's clock has not come yet.
    } else if (!started || now + kStep < time_) {
      if (started) ROS_WARN("time went back to %.3f s: the stub goes on from there", 1e-9 * static_cast<double>(now));
      restartAt(ros::Time::now());
      started = true;
    } else if (now > time_ + kLongestGap) {
      ROS_WARN_THROTTLE(kStaleReport, "the simulation was interrupted for %.2f s: the robot did not move in this time",
                        1e-9 * static_cast<double>(now - time_));
      time_ = now;
    }
    while (started && time_ + kStep <= now) advance();
    ros::WallDuration(0.002).sleep();
  }
}

void Create2Stub::restartAt(const ros::Time& time) {
  time_ = time.toNSec();
  for (Schedule* schedule : {&driver_loop_, &encoders_, &clock_}) schedule->restart(time_);
  scanner_.restart(time_);
  if (second_scanner_) second_scanner_->restart(time_);
  publishStaticTransforms();
  if (parameters_.publish_map) publishMap();
}

ros::Time Create2Stub::simulatedTime() const { return ros::Time().fromNSec(time_); }

ros::Time Create2Stub::driverTime() const {
  return parameters_.publish_clock ? simulatedTime() : std::max(simulatedTime(), ros::Time::now());
}

void Create2Stub::advance() {
  time_ += kStep;
  robot_.step(kStepSeconds);
  if (parameters_.publish_clock && clock_.due(time_)) {
    rosgraph_msgs::Clock message;
    message.clock = simulatedTime();
    clock_publisher_.publish(message);
  }
  if (robot_.contacts() != contacts_published_) publishContacts();
  if (encoders_.due(time_)) driver_.readEncoders(1.0 / kEncoderRate);
  publishScans();
  if (driver_loop_.due(time_)) {
    driver_.update(simulatedTime());
    if (isLocalised()) publishLocalisation();
  }
}

void Create2Stub::publishScans() {
  const Pose2& pose = robot_.robot().truePose();
  if (second_scanner_) second_scanner_->publishIfDue(world_, pose, time_);
  if (scanner_.publishIfDue(world_, pose, time_)) publishGroundTruth();
}

void Create2Stub::publishGroundTruth() {
  nav_msgs::Odometry message;
  message.header.stamp = simulatedTime();
  message.header.frame_id = parameters_.map_frame;
  message.child_frame_id = parameters_.base_frame;
  message.pose.pose = toMessage(robot_.robot().truePose());
  message.twist.twist.linear.x = robot_.robot().measuredTwist().linear;
  message.twist.twist.angular.z = robot_.robot().measuredTwist().angular;
  truth_publisher_.publish(message);
}

void Create2Stub::publishContacts() {
  contacts_published_ = robot_.contacts();
  const Pose2& pose = robot_.robot().truePose();
  if (contacts_published_ > 0) ROS_WARN("contact %u at (%.2f, %.2f)", contacts_published_, pose.x, pose.y);
  std_msgs::UInt32 message;
  message.data = contacts_published_;
  contacts_publisher_.publish(message);
}

void Create2Stub::publishStaticTransforms() {
  const ros::Time now = simulatedTime();
  std::vector<geometry_msgs::TransformStamped> transforms;
  // Where several robots share tf, their frames begin with their names.
  const std::string base_link = parameters_.base_frame.substr(0, parameters_.base_frame.rfind('/') + 1) + "base_link";
  if (parameters_.publish_static_tf) {
    transforms.push_back(toMessage(Pose2{}, parameters_.base_frame, base_link, now));
    transforms.back().transform.translation.z = parameters_.base_link_height;
    transforms.push_back(mountToMessage(parameters_.laser.mount, base_link, parameters_.laser_frame, now));
    transforms.back().transform.translation.z = parameters_.laser_height;
    if (second_scanner_) {
      const SensorMount& mount = parameters_.second_laser.mount;
      transforms.push_back(mountToMessage(mount, base_link, parameters_.second_laser_frame, now));
      transforms.back().transform.translation.z = parameters_.second_laser_height;
    }
  }
  if (parameters_.publish_map && !isLocalised()) {
    transforms.push_back(toMessage(parameters_.start, parameters_.map_frame, parameters_.odom_frame, now));
  }
  static_broadcaster_.sendTransform(transforms);
}

void Create2Stub::publishLocalisation() {
  localiser_.localise(robot_.robot().truePose(), driver_.odometry());
  const Pose2 map_from_odometry = compose(parameters_.start, localiser_.correction());
  broadcaster_.sendTransform(toMessage(map_from_odometry, parameters_.map_frame, parameters_.odom_frame, driverTime()));
}

void Create2Stub::publishMap() {
  const auto* grid_world = dynamic_cast<const GridWorld*>(building_.get());
  if (grid_world == nullptr) return;
  const OccupancyGrid& grid = grid_world->grid();
  nav_msgs::OccupancyGrid message;
  message.header.stamp = simulatedTime();
  message.header.frame_id = parameters_.map_frame;
  message.info.resolution = static_cast<float>(grid.resolution());
  message.info.width = static_cast<std::uint32_t>(grid.columns());
  message.info.height = static_cast<std::uint32_t>(grid.rows());
  message.info.origin = toMessage(grid.origin());
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const Cell cell = grid.at({column, row});
      message.data.push_back(cell == Cell::kUnknown ? -1 : cell == Cell::kOccupied ? 100 : 0);
    }
  }
  if (!map_publisher_) map_publisher_ = node_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
  map_publisher_.publish(message);
}

bool Create2Stub::jumpOdometry(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  driver_.jumpOdometry(parameters_.odometry_jump);
  response.success = true;
  return true;
}

}  // namespace lstm_planner
