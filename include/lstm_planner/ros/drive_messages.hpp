#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2/buffer_core.h>

#include <map>
#include <optional>
#include <string>

#include "lstm_planner/dataset/drive_recorder.hpp"

namespace lstm_planner {

/// Tells a DriveRecorder what ROS messages say, the same for topics and for bags. `received` stands in for the stamps of
/// messages that have none. Nothing is thrown: what cannot be used is rejected. Not thread safe.
class DriveMessages {
 public:
  /// `tf` and `sink` must outlive the object; the transforms need not be there yet. `base_frame`: the robot's, where the
  /// odometry does not name it. `mount`: where the scanner sits, for recordings without the transform.
  DriveMessages(const tf2::BufferCore& tf, const std::string& base_frame, const std::optional<SensorMount>& mount,
                const RecorderParameters& parameters, StepSink* sink);

  void hear(const sensor_msgs::LaserScan& scan, const ros::Time& received);
  void hear(const nav_msgs::Odometry& odometry, const ros::Time& received);
  /// A goal that is driven to from now on. `source`: Episode::goal_source. The same goal heard twice, as move_base_simple's
  /// from move_base, is one.
  void hearGoal(const geometry_msgs::PoseStamped& goal, const std::string& source, const ros::Time& received);
  /// The goal is not driven to any more: cancelled or given up. `stamp`: when.
  void hearEnd(const ros::Time& stamp);

  DriveRecorder& recorder() { return recorder_; }
  const std::string& odometryFrame() const { return odometry_frame_; }  ///< empty before the first odometry

 private:
  std::optional<Pose2> locate(const std::string& frame, double stamp) const;
  const SensorMount* mountOf(const std::string& frame);

  const tf2::BufferCore& tf_;
  std::string base_frame_;
  std::string odometry_frame_;
  std::optional<SensorMount> given_mount_;
  std::map<std::string, SensorMount> mounts_;  ///< by the scanner's frame
  DriveRecorder recorder_;
};

}  // namespace lstm_planner
