#pragma once

#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <std_srvs/SetBool.h>

#include <cstdint>
#include <string>

#include "lstm_planner/simulation/hokuyo.hpp"
#include "ros/create2_stub/schedule.hpp"

namespace lstm_planner {

/// A scanner of the simulated robot, as its driver shows it to ROS.
class Create2StubScanner {
 public:
  /// Publishes on `topic`; the private service "pause_" + topic (std_srvs/SetBool) stops the scans.
  Create2StubScanner(const HokuyoParameters& parameters, std::uint64_t seed, const std::string& frame,
                     const std::string& topic);

  void restart(std::uint64_t now) { schedule_.restart(now); }

  /// Publishes a scan if one is due at `now` (ns), with the robot at `pose`. False if none is due.
  bool publishIfDue(const World& world, const Pose2& pose, std::uint64_t now);

 private:
  bool pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);

  Hokuyo laser_;
  Schedule schedule_;
  LaserScan scan_;
  sensor_msgs::LaserScan message_;
  bool is_paused_ = false;
  ros::Publisher publisher_;
  ros::ServiceServer pause_service_;
};

}  // namespace lstm_planner
