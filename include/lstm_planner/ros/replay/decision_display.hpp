#pragma once

#include <string>

#include "lstm_planner/practice/decision_replay.hpp"
#include "lstm_planner/ros/planner/decision_publisher.hpp"
#include "lstm_planner/ros/planner/marker_publisher.hpp"
#include "lstm_planner/ros/replay/driver_markers.hpp"

namespace lstm_planner {

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
