#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <deque>
#include <string>

#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"

namespace lstm_planner {

/// Shows in rviz what the planner sees and decides, as in the thesis's figures 4.6 and 4.11 to 4.13, on `markers`.
///
/// Namespaces: sectors (purple: an arc for each of the eight averages), preferences (an arrow for each steering angle,
/// the longer the more preferred, grey where the shield forbids it), waypoint (orange), trace (red), goal (green).
class MarkerPublisher {
 public:
  /// `trace_length`: poses of the trace that are kept.
  MarkerPublisher(ros::NodeHandle node_handle, const PolicyDescription& description, int trace_length);

  /// `header`: time, and the frame of poses and goal. Cheap while nobody listens.
  void publish(const std_msgs::Header& header, const Situation& situation, const Decision& decision, const Pose2& goal);

  void clearTrace() { trace_.clear(); }
  void setTraceLength(int poses) { trace_length_ = static_cast<std::size_t>(poses); }

  bool isListenedTo() const { return publisher_.getNumSubscribers() > 0; }

 private:
  void extendTrace(const Pose2& pose);
  void addPreferences(const std_msgs::Header& header, const Situation& situation, const Decision& decision);
  void addWaypoint(const std_msgs::Header& header, const Decision& decision);

  PolicyDescription description_;
  std::size_t trace_length_;
  std::deque<Point2> trace_;
  visualization_msgs::MarkerArray markers_;
  ros::Publisher publisher_;
};

}  // namespace lstm_planner
