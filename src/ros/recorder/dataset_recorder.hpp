#pragma once

#include <csignal>
#include <memory>

#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"

namespace lstm_planner {

/// The node `dataset_recorder`: makes a dataset of how somebody drives the robot, whoever that is.
///
/// Subscribed topics:
///  - `scan` (sensor_msgs/LaserScan), `odom` (nav_msgs/Odometry), and tf, for where the scanner sits
///  - `move_base/goal` (move_base_msgs/MoveBaseActionGoal), `move_base_simple/goal` (geometry_msgs/PoseStamped): the
///    goal that is driven to
///  - `move_base/cancel` (actionlib_msgs/GoalID), `move_base/result` (move_base_msgs/MoveBaseActionResult): its end,
///    unless it succeeded; arrival is told by odometry
///
/// Published topics:
///  - `~goal` (geometry_msgs/PoseStamped, latched): the waypoint to drive to, where there are waypoints
///  - `~markers` (visualization_msgs/MarkerArray): what is recorded, see RecorderMarkers
///  - `/diagnostics` (diagnostic_msgs/DiagnosticArray), once a second of the computer's clock, and after every service;
///    the same in short goes into the log every ten seconds
///
/// Services:
///  - `~pause` (std_srvs/SetBool): true: nothing becomes a step until false. Ends the running episode
///  - `~discard_episode` (std_srvs/Trigger): the running episode, or else the last one, is not to be learned from. The
///    goal stays the goal; a new episode starts
///  - `~finish` (std_srvs/Trigger): writes everything, marks the recording as finished, and ends the node
///
/// Parameters: RecorderNodeParameters.
///
/// The file is made when the first odometry is heard: there is none of a robot that was not there.
class DatasetRecorder {
 public:
  explicit DatasetRecorder(const RecorderNodeParameters& parameters);
  ~DatasetRecorder();
  DatasetRecorder(const DatasetRecorder&) = delete;
  DatasetRecorder& operator=(const DatasetRecorder&) = delete;

  /// Records until `stop` is not 0, ROS is shut down or ~finish is called; then all that was heard is written. Returns
  /// the node's exit code: 0, or 1 when the file could not be made or not all steps could be written.
  int run(const volatile std::sig_atomic_t& stop);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lstm_planner
