#pragma once

#include <ros/publisher.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "lstm_planner/practice/decision_replay.hpp"
#include "lstm_planner/ros/planner/decision_publisher.hpp"
#include "lstm_planner/ros/planner/marker_publisher.hpp"

namespace lstm_planner {

/// Shows what the planner would do beside what somebody else does who drives, stamped as the scan that was decided
/// about: the planner on ~LstmGlobalPlanner/markers and ~LstmGlobalPlanner/decision, the driver on `~driver`.
///
/// Namespaces of `~driver`: path (blue), driven (blue: an arrow for the driver's angle at each step), planned (an arrow
/// for the planner's, green where it is the same steering angle, red where it is not), agreement (how often it was so
/// far).
class DecisionDisplay {
 public:
  explicit DecisionDisplay(const PolicyDescription& description);

  /// `frame`: the odometry's.
  void showAdvice(const ReplayedDecision& replayed, const std::string& frame);
  void showDriver(const ReplayedDecision& replayed, const std::string& frame);

  /// Forgets the driver's path and all arrows, so that a long drive does not fill messages without end; they leave the
  /// screen when the next step is shown. What was agreed on counts on.
  void clearPath();

  bool isListenedTo() const;

 private:
  MarkerPublisher markers_;
  DecisionPublisher decisions_;
  visualization_msgs::MarkerArray driver_markers_;
  long steps_ = 0;
  long agreed_ = 0;
  ros::Publisher driver_publisher_;
};

}  // namespace lstm_planner
