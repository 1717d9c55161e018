#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/drive/decision/arrival.hpp"

namespace lstm_planner {

/// How a drive ended.
struct DriveEnd {
  Point2 goal;             ///< global frame
  double distance = 0.0;   ///< m, of the robot from the goal
  bool is_beside = false;  ///< the goal seems to lie in or behind an obstacle
  bool is_arrival = true;  ///< see AgentParameters::arrive_beside_goal
  /// "stopped 1.32 m from the goal, ...".
  std::string text() const {
    if (is_beside) {
      return besideGoalText(distance) + ": this " + (is_arrival ? "counts" : "does not count") +
             " as arrived (arrive_beside_goal)";
    }
    return "stopped " + fixedText(distance, 2) + " m from the goal";
  }
};

/// Publishes how the last drive ended on `arrival` (diagnostic_msgs/DiagnosticStatus, latched), for programs that send
/// goals: OK at the goal, a warning if the robot stopped beside it, an error if that does not count as arrived. The
/// message is DriveEnd::text(). Values: frame, goal (x, y in m), distance (m), beside_goal, arrived.
class ArrivalPublisher {
 public:
  explicit ArrivalPublisher(ros::NodeHandle node_handle)
      : publisher_(node_handle.advertise<DiagnosticStatus>("arrival", 1, true)) {}

  void publish(const DriveEnd& end, const std::string& frame) {
    diagnostic_updater::DiagnosticStatusWrapper status;
    status.name = "lstm_planner: arrival";
    status.summary(levelOf(end), end.text());
    status.add("frame", frame);
    status.add("goal", std::to_string(end.goal.x) + ", " + std::to_string(end.goal.y));
    status.add("distance", end.distance);
    status.add("beside_goal", end.is_beside ? "true" : "false");
    status.add("arrived", end.is_arrival ? "true" : "false");
    publisher_.publish(static_cast<const DiagnosticStatus&>(status));
  }

 private:
  using DiagnosticStatus = diagnostic_msgs::DiagnosticStatus;

  static unsigned char levelOf(const DriveEnd& end) {
    if (!end.is_arrival) return DiagnosticStatus::ERROR;
    return end.is_beside ? DiagnosticStatus::WARN : DiagnosticStatus::OK;
  }

  ros::Publisher publisher_;
};

}  // namespace lstm_planner
