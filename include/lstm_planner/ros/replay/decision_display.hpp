#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "lstm_planner/practice/decision_replay.hpp"
#include "lstm_planner/ros/planner/decision_publisher.hpp"
#include "lstm_planner/ros/planner/marker_publisher.hpp"

namespace lstm_planner {

/// Shows in rviz, on `driver`, which way the driver went and where the planner would have gone elsewhere.
///
/// Namespaces: path (blue), driven (blue: an arrow for the driver's angle at each step), planned (an arrow for the
/// planner's, green where it is the same steering angle, red where it is not), agreement (how often it was so far).
class DriverMarkers {
 public:
  explicit DriverMarkers(ros::NodeHandle node_handle);

  /// `frame`: the odometry's.
  void add(const ReplayedDecision& replayed, const std::string& frame);

  /// Forgets path and arrows, so that a long drive does not fill messages without end; they leave the screen when the
  /// next step is shown. What was agreed on counts on.
  void clear();

  bool isListenedTo() const { return publisher_.getNumSubscribers() > 0; }

 private:
  visualization_msgs::MarkerArray markers_;
  long steps_ = 0;
  long agreed_ = 0;
  ros::Publisher publisher_;
};

/// Shows what the planner would do beside what somebody else does who drives, on ~LstmGlobalPlanner/markers,
/// ~LstmGlobalPlanner/decision and ~driver (DriverMarkers), stamped as the scan that was decided about.
class DecisionDisplay {
 public:
  explicit DecisionDisplay(const PolicyDescription& description);

  /// `frame`: the odometry's.
  void showAdvice(const ReplayedDecision& replayed, const std::string& frame);
  void showDriver(const ReplayedDecision& replayed, const std::string& frame) { driver_.add(replayed, frame); }
  void clearPath() { driver_.clear(); }

  bool isListenedTo() const { return markers_.isListenedTo() || decisions_.isListenedTo() || driver_.isListenedTo(); }

 private:
  MarkerPublisher markers_;
  DecisionPublisher decisions_;
  DriverMarkers driver_;
};

}  // namespace lstm_planner
