#pragma once

#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <std_srvs/SetBool.h>

#include <cstdint>
#include <string>

#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"
#include "ros/create2_stub/schedule.hpp"

namespace lstm_planner {

/// A scanner of the simulated robot, as its driver shows it to ROS.
class Create2StubScanner {
 public:
  /// Publishes on `topic`; the private service "pause_" + topic (std_srvs/SetBool) stops the scans.
  Create2StubScanner(const HokuyoParameters& parameters, std::uint64_t seed, const std::string& frame,
                     const std::string& topic)
      : laser_(parameters, seed),
        schedule_(parameters.rate),
        publisher_(ros::NodeHandle().advertise<sensor_msgs::LaserScan>(topic, 20)),
        pause_service_(ros::NodeHandle("~").advertiseService("pause_" + topic, &Create2StubScanner::pause, this)) {
    message_.header.frame_id = frame;
    message_.time_increment = static_cast<float>(kTimeIncrement);
    message_.scan_time = static_cast<float>(1.0 / parameters.rate);
  }

  void restart(std::uint64_t now) { schedule_.restart(now); }

  /// Publishes a scan if one is due at `now` (ns), with the robot at `pose`. False if none is due.
  bool publishIfDue(const World& world, const Pose2& pose, std::uint64_t now) {
    if (!schedule_.due(now)) return false;
    if (is_paused_) return true;
    laser_.scan(world, pose, 1e-9 * static_cast<double>(now), &scan_);
    message_.header.stamp.fromNSec(now);
    toMessage(scan_, &message_);
    publisher_.publish(message_);
    return true;
  }

 private:
  static constexpr double kTimeIncrement = 1.7361e-5;  // s between two beams

  bool pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
    is_paused_ = request.data;
    response.success = true;
    response.message = is_paused_ ? "no scans" : "scans";
    return true;
  }

  Hokuyo laser_;
  Schedule schedule_;
  LaserScan scan_;
  sensor_msgs::LaserScan message_;
  bool is_paused_ = false;
  ros::Publisher publisher_;
  ros::ServiceServer pause_service_;
};

}  // namespace lstm_planner
