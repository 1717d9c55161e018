#include "ros/create2_stub/create2_stub_scanner.hpp"

#include "lstm_planner/ros/common/conversions.hpp"

namespace lstm_planner {
namespace {

constexpr double kTimeIncrement = 1.7361e-5;  // s between two beams

}  // namespace

Create2StubScanner::Create2StubScanner(const HokuyoParameters& parameters, std::uint64_t seed, const std::string& frame,
                                       const std::string& topic)
    : laser_(parameters, seed),
      schedule_(parameters.rate),
      publisher_(ros::NodeHandle().advertise<sensor_msgs::LaserScan>(topic, 20)),
      pause_service_(ros::NodeHandle("~").advertiseService("pause_" + topic, &Create2StubScanner::pause, this)) {
  message_.header.frame_id = frame;
  message_.time_increment = static_cast<float>(kTimeIncrement);
  message_.scan_time = static_cast<float>(1.0 / parameters.rate);
}

bool Create2StubScanner::publishIfDue(const World& world, const Pose2& pose, std::uint64_t now) {
  if (!schedule_.due(now)) return false;
  if (is_paused_) return true;
  laser_.scan(world, pose, 1e-9 * static_cast<double>(now), &scan_);
  message_.header.stamp.fromNSec(now);
  toMessage(scan_, &message_);
  publisher_.publish(message_);
  return true;
}

bool Create2StubScanner::pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  is_paused_ = request.data;
  response.success = true;
  response.message = is_paused_ ? "no scans" : "scans";
  return true;
}

}  // namespace lstm_planner
