#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// How a drive ended.
struct DriveEnd {
  Point2 goal;               ///< global frame
  double distance = 0.0;     ///< m, of the robot from the goal
  bool is_beside = false;    ///< the goal seems to lie in or behind an obstacle
  bool is_arrival = true;    ///< see AgentParameters::arrive_beside_goal
  std::string text() const;  ///< "stopped 1.32 m from the goal, ..."
};

/// Publishes how the last drive ended on `arrival` (diagnostic_msgs/DiagnosticStatus, latched), for programs that send
/// goals: OK at the goal, a warning if the robot stopped beside it, an error if that does not count as arrived. The
/// message is DriveEnd::text(). Values: frame, goal (x, y in m), distance (m), beside_goal, arrived.
class ArrivalPublisher {
 public:
  explicit ArrivalPublisher(ros::NodeHandle node_handle);

  void publish(const DriveEnd& end, const std::string& frame);

 private:
  ros::Publisher publisher_;
};

}  // namespace lstm_planner
