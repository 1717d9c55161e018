#pragma once

#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>

#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/ros/common/conversions.hpp"

namespace lstm_planner {

/// A recording, and what it does not say itself.
struct RecordedBag {
  std::string file;
  std::string global_frame;  ///< of the costmap; where it is not the odometry's, the recording has the transform
  std::string scan_frame;    ///< the scanner's, where the recording does not say where it sits; else empty
  double max_speed;          ///< m/s
  bool has_gaps;             ///< longer than the planner's timeouts
  bool is_shipped = false;   ///< comes with the package
};

inline void PrintTo(const RecordedBag& recording, std::ostream* out) { *out << recording.file; }

inline std::string nameOf(const testing::TestParamInfo<RecordedBag>& info) {
  return info.param.file.substr(0, info.param.file.find('.'));
}

/// Where the robot was, and how far it had driven until then.
struct Waypoint {
  ros::Time stamp;
  Pose2 pose;
  double driven = 0.0;  ///< m
};

/// A recording that was read once: its clock, and the path of its robot.
class RecordedPath {
 public:
  /// Throws std::runtime_error when there are fewer than two odometry messages.
  explicit RecordedPath(const rosbag::Bag& bag) {
    rosbag::View view(bag);
    for (const rosbag::MessageInstance& message : view) {
      if (const auto scan = message.instantiate<sensor_msgs::LaserScan>()) {
        clock_difference_ = std::min(clock_difference_, message.getTime() - scan->header.stamp);
      } else if (const auto odometry = message.instantiate<nav_msgs::Odometry>()) {
        clock_difference_ = std::min(clock_difference_, message.getTime() - odometry->header.stamp);
        add(odometry->header.stamp, fromMessage(odometry->pose.pose));
      }
    }
    if (path_.size() < 2) {
      throw std::runtime_error("there is no odometry in " + bag.getFileName());
    }
  }

  /// The recording computer's clock may differ from the robot's by anything. The replay's clock is the robot's: the
  /// message that was on its way for the shortest time took none.
  ros::Time clockAt(const ros::Time& recorded) const { return recorded - clock_difference_; }

  /// The first place that the robot comes to after driving on for `distance` (m), or else its last.
  const Waypoint& ahead(const ros::Time& now, double distance) const {
    const auto here = std::find_if(path_.begin(), path_.end() - 1, [&](const Waypoint& at) { return at.stamp >= now; });
    return *std::find_if(here, path_.end() - 1,
                         [&](const Waypoint& at) { return at.driven >= here->driven + distance; });
  }

  const std::vector<Waypoint>& path() const { return path_; }

 private:
  void add(const ros::Time& stamp, const Pose2& pose) {
    const double driven = path_.empty() ? 0.0 : path_.back().driven + distanceBetween(path_.back().pose, pose);
    path_.push_back({stamp, pose, driven});
  }

  ros::Duration clock_difference_ = ros::DURATION_MAX;
  std::vector<Waypoint> path_;
};

}  // namespace lstm_planner
