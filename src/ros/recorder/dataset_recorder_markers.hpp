#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <visualization_msgs/MarkerArray.h>

#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/drive/decision/goal_tracker.hpp"
#include "lstm_planner/drive/perception/situation.hpp"
#include "ros/recorder/dataset_recorder_status.hpp"

namespace lstm_planner {

/// Shows in rviz what is recorded, on `markers`.
///
/// Namespaces: sectors (purple: the eight averages of the last look), path (red: of the running episode), labels (an
/// arrow at each of its steps, the path that was taken from there: red to the left, green ahead, blue to the right),
/// goal (green).
class RecorderMarkers {
 public:
  /// `node_handle`: the node's private one. `action_angles`: rad, the labels'.
  RecorderMarkers(ros::NodeHandle node_handle, const std::vector<double>& action_angles);

  /// `frame`: the odometry's. Once a look; cheap while nobody listens.
  void publish(const std::string& frame, const Situation& situation, const RecordingProgress& progress,
               const std::optional<GoalInFrame>& goal);

 private:
  visualization_msgs::Marker labelMarker(const std_msgs::Header& header,
                                         const RecordingProgress::EpisodeProgress& episode) const;

  std::vector<double> action_angles_;
  ros::Publisher publisher_;
  double last_look_ = 0.0;  ///< s
};

}  // namespace lstm_planner
