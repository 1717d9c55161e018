#pragma once

#include <ros/node_handle.h>
#include <ros/time.h>

#include <string>
#include <vector>

#include "lstm_planner/robot/evaluation/decision_replay.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/planner/decision_publisher.hpp"
#include "lstm_planner/ros/planner/marker_publisher.hpp"
#include "lstm_planner/ros/recorder/bag_drive.hpp"
#include "lstm_planner/ros/replay/bag_replay_driver.hpp"
#include "lstm_planner/ros/replay/bag_replay_player.hpp"

namespace lstm_planner {

/// What `bag_replay` reads from its private namespace; launch/replay.launch has an argument for each.
struct BagReplayParameters {
  std::string bag;  ///< ~bag: path of a recording with scan and odometry or tf
  /// ~scan_topic, ~odometry_topic, ~goal_topic, ~odometry_frame, ~base_frame, ~mount, ~hindsight
  BagDriveOptions drive;
  GlobalPlannerParameters planner;  ///< ~LstmGlobalPlanner/...: as in move_base
  double rate = 1.0;                ///< ~rate: s of the recording in a second; 0 = as fast as possible
  double patience = 10.0;           ///< ~patience: s (the computer's) to wait at the start until somebody listens
  bool stay = false;                ///< ~stay: whether to wait for Ctrl-C at the end, so that the last can be seen
  std::string decisions;            ///< ~decisions: path of a CSV file for the decisions; none when empty
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
BagReplayParameters loadBagReplayParameters(const ros::NodeHandle& private_node);

/// The node `bag_replay`: plays a recording with /clock, scan, odom and tf, and shows what the planner would have
/// decided at each step beside what the driver did.
///
/// All is decided before anything is played, from the stamps of the recording, so neither the rate nor the load of the
/// computer has a say in it. Topics: ~LstmGlobalPlanner/markers and ~LstmGlobalPlanner/decision, stamped as the scan
/// that was decided about; ~driver (BagReplayDriver).
class BagReplay {
 public:
  /// Reads the recording and decides. Throws std::invalid_argument when that cannot be done.
  explicit BagReplay(const BagReplayParameters& parameters);

  /// Plays it to the end, or until the node is shut down, and logs how often planner and driver agreed.
  void run();

 private:
  void writeDecisionsFile() const;
  void waitForListeners() const;
  void showDecisionsUntil(const ros::Time& time);
  void show(const ReplayedDecision& replayed);

  BagReplayParameters parameters_;
  DecisionReplay replay_;
  BagDriveResult drive_;
  BagReplayPlayer player_;
  std::size_t shown_ = 0;  ///< decisions

  MarkerPublisher markers_;
  DecisionPublisher decisions_;
  BagReplayDriver driver_;
};

/// "71 decisions in 2 episodes (network 60, goal in sight 11): the planner took the driver's steering angle at 52 (73
/// %), their angles differ by 14 degrees on average; not decided about: 5 standing".
std::string describeReplay(const DecisionReplay& replay);

}  // namespace lstm_planner
