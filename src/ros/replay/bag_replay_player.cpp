#include "lstm_planner/ros/replay/bag_replay_player.hpp"

#include <nav_msgs/OccupancyGrid.h>
#include <rosbag/exceptions.h>
#include <rosbag/view.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

#include "lstm_planner/common/input_file.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/recorder/bag_message.hpp"

namespace lstm_planner {

namespace {

constexpr int kQueue = 1000;  // what is played as fast as possible comes faster than it is sent

bool isTransforms(const std::string& topic) { return topic == "/tf" || topic == "tf"; }
bool isStaticTransforms(const std::string& topic) { return topic == "/tf_static" || topic == "tf_static"; }

}  // namespace

BagReplayPlayer::BagReplayPlayer(const std::string& path, const Topics& topics)
    : topics_(topics),
      clock_(node_.advertise<rosgraph_msgs::Clock>("/clock", kQueue)),
      scans_(node_.advertise<sensor_msgs::LaserScan>("scan", kQueue)),
      odometry_(node_.advertise<nav_msgs::Odometry>("odom", kQueue)),
      transforms_(node_.advertise<tf2_msgs::TFMessage>("/tf", kQueue)),
      map_(node_.advertise<nav_msgs::OccupancyGrid>("map", 1, true)) {
  try {
    checkInputFile(path, std::numeric_limits<std::uintmax_t>::max());
    bag_.open(path);
    readClock();
  } catch (const InputFileError& error) {
    throw std::invalid_argument("'" + path + "' cannot be read: " + error.what());
  } catch (const rosbag::BagException& error) {
    throw std::invalid_argument("'" + path + "' cannot be read: " + error.what());
  }
}

void BagReplayPlayer::readClock() {
  rosbag::View view(bag_);
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    has_transforms_ = has_transforms_ || isTransforms(connection->topic);
  }
  rosbag::View sensors(bag_, rosbag::TopicQuery(std::vector<std::string>{topics_.scan, topics_.odometry}));
  for (const rosbag::MessageInstance& message : sensors) {
    std_msgs::Header header;
    if (const auto scan = messageOf<sensor_msgs::LaserScan>(message)) {
      header = scan->header;
      if (scan_frame_.empty()) scan_frame_ = frameName(header.frame_id);
    } else if (const auto odometry = messageOf<nav_msgs::Odometry>(message)) {
      header = odometry->header;
      if (odometry_frame_.empty()) odometry_frame_ = frameName(header.frame_id);
      if (base_frame_.empty()) base_frame_ = robotFrameOf(*odometry);
    }
    if (!header.stamp.isZero()) {
      clock_difference_ = std::min(clock_difference_, message.getTime() - header.stamp);
    }
  }
  if (clock_difference_ == ros::DURATION_MAX) {
    clock_difference_ = ros::Duration(0.0);
  }
}

void BagReplayPlayer::placeScanner(const SensorMount& mount, const std::string& base_frame) {
  static_transforms_.sendTransform(mountToMessage(mount, base_frame, scan_frame_));
}

void BagReplayPlayer::play(double rate, const std::function<void(const ros::Time&)>& at) {
  rosbag::View view(bag_);
  began_.reset();
  for (const rosbag::MessageInstance& message : view) {
    if (!ros::ok()) {
      return;
    }
    const ros::Time time = message.getTime() - clock_difference_;
    waitUntil(time, rate);
    tellTime(time);
    at(time);
    publish(message);
  }
}

void BagReplayPlayer::waitUntil(const ros::Time& time, double rate) {
  constexpr double kClockPeriod = 0.02;  // s of the computer's, also where the recording is silent
  if (!began_) {
    began_ = time;
    wall_began_ = ros::WallTime::now();
  }
  if (rate <= 0.0) {
    return;
  }
  const ros::WallTime due = wall_began_ + ros::WallDuration((time - *began_).toSec() / rate);
  for (ros::WallTime now = ros::WallTime::now(); now < due && ros::ok(); now = ros::WallTime::now()) {
    tellTime(*began_ + ros::Duration((now - wall_began_).toSec() * rate));
    std::min(ros::WallDuration(kClockPeriod), due - now).sleep();
  }
}

void BagReplayPlayer::tellTime(const ros::Time& time) {
  rosgraph_msgs::Clock clock;
  clock.clock = time;
  clock_.publish(clock);
}

void BagReplayPlayer::publish(const rosbag::MessageInstance& message) {
  const std::string& topic = message.getTopic();
  if (topic == topics_.scan) {
    if (const auto scan = messageOf<sensor_msgs::LaserScan>(message)) scans_.publish(scan);
  } else if (topic == topics_.odometry) {
    const auto odometry = messageOf<nav_msgs::Odometry>(message);
    if (!odometry) return;
    odometry_.publish(odometry);
    if (!has_transforms_) publishPose(*odometry);
  } else if (isTransforms(topic)) {
    if (const auto transforms = messageOf<tf2_msgs::TFMessage>(message)) transforms_.publish(transforms);
  } else if (isStaticTransforms(topic)) {
    const auto transforms = messageOf<tf2_msgs::TFMessage>(message);
    if (transforms) static_transforms_.sendTransform(transforms->transforms);
  } else if (const auto map = messageOf<nav_msgs::OccupancyGrid>(message)) {
    map_.publish(map);
  }
}

void BagReplayPlayer::publishPose(const nav_msgs::Odometry& odometry) {
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(
      toMessage(fromMessage(odometry.pose.pose), odometry_frame_, base_frame_, odometry.header.stamp));
  transforms_.publish(transforms);
}

}  // namespace lstm_planner
