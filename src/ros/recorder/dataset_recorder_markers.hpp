#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/drive/decision/goal_tracker.hpp"
#include "lstm_planner/drive/perception/situation.hpp"
#include "lstm_planner/ros/planner/marker_shapes.hpp"
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
  RecorderMarkers(ros::NodeHandle node_handle, const std::vector<double>& action_angles)
      : action_angles_(action_angles),
        publisher_(node_handle.advertise<visualization_msgs::MarkerArray>("markers", 1)) {}

  /// `frame`: the odometry's. Once a look; cheap while nobody listens.
  void publish(const std::string& frame, const Situation& situation, const RecordingProgress& progress,
               const std::optional<GoalInFrame>& goal) {
    if (situation.time == last_look_) return;
    last_look_ = situation.time;
    if (publisher_.getNumSubscribers() == 0) return;

    std_msgs::Header header;
    header.frame_id = frame;
    header.stamp = ros::Time(situation.time);
    visualization_msgs::MarkerArray markers;
    markers.markers.push_back(makeMarker(header, "", 0, Marker::CUBE, {}));
    markers.markers.back().action = Marker::DELETEALL;
    markers.markers.push_back(makeSectorMarker(header, situation.pose, situation.sectors, M_PI));
    const auto& episode = progress.newest();
    if (episode && episode->episode.end == EpisodeEnd::kRunning && !episode->poses.empty()) {
      std::vector<Point2> path;
      for (const Pose2& pose : episode->poses) path.push_back({pose.x, pose.y});
      path.push_back({situation.pose.x, situation.pose.y});
      markers.markers.push_back(makeTraceMarker(header, "path", path));
      markers.markers.push_back(labelMarker(header, *episode));
    }
    if (goal) {
      // The newest transform will do: the goal's frame may be one that moves against the odometry's.
      std_msgs::Header goal_header;
      goal_header.frame_id = goal->frame;
      addGoalMarkers(goal_header, goal->pose, &markers);
    }
    publisher_.publish(markers);
  }

 private:
  using Marker = visualization_msgs::Marker;

  /// Blue for the rightmost label, green for the middle one, red for the leftmost.
  static std_msgs::ColorRGBA colorOf(int label, std::size_t labels) {
    const double share = labels > 1 ? static_cast<double>(label) / static_cast<double>(labels - 1) : 0.5;
    return makeColor(std::max(0.0, 2.0 * share - 1.0), 0.8 - 1.2 * std::abs(share - 0.5),
                     std::max(0.0, 1.0 - 2.0 * share));
  }

  visualization_msgs::Marker labelMarker(const std_msgs::Header& header,
                                         const RecordingProgress::EpisodeProgress& episode) const {
    constexpr std::size_t kMostArrows = 1000;
    constexpr double kLength = 0.25;  // m
    Marker lines = makeMarker(header, "labels", 0, Marker::LINE_LIST, makeColor(0.0, 0.8, 0.0));
    lines.scale.x = 0.025;
    const std::size_t count = episode.poses.size();
    for (std::size_t i = count > kMostArrows ? count - kMostArrows : 0; i < count; ++i) {
      const int label = episode.labels[i];
      const double angle = action_angles_.at(static_cast<std::size_t>(label));
      addArrow(episode.poses[i], angle, kLength, kArrowHeight, colorOf(label, action_angles_.size()), &lines);
    }
    return lines;
  }

  std::vector<double> action_angles_;
  ros::Publisher publisher_;
  double last_look_ = 0.0;  ///< s
};

}  // namespace lstm_planner
