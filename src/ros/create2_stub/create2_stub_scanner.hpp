#pragma once

#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <std_srvs/SetBool.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "lstm_planner/drive/perception/odometry_history.hpp"
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
    const BeamTimes& times = parameters.beam_times;
    message_.time_increment = static_cast<float>((times.last - times.first) / std::max(1, parameters.beams - 1));
    message_.scan_time = static_cast<float>(1.0 / parameters.rate);
  }

  void restart(std::uint64_t now) { schedule_.restart(now); }

  /// Publishes a scan if one is due at `now` (ns), when its last beam is measured. `poses`: where the robot was. False
  /// if none is due.
  bool publishIfDue(const World& world, const OdometryHistory& poses, std::uint64_t now) {
    if (!schedule_.due(now)) return false;
    if (is_paused_) return true;
    const auto poseAt = [&poses](double time) { return poses.poseAt(time); };
    laser_.sweep(world, poseAt, laser_.stampOf(1e-9 * static_cast<double>(now)), &scan_);
    message_.header.stamp.fromSec(scan_.stamp);
    toMessage(scan_, &message_);
    publisher_.publish(message_);
    return true;
  }

 private:
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
