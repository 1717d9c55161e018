#pragma once

#include <actionlib_msgs/GoalID.h>
#include <geometry_msgs/PoseStamped.h>
#include <move_base_msgs/MoveBaseActionGoal.h>
#include <move_base_msgs/MoveBaseActionResult.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2/buffer_core.h>

#include <optional>
#include <string>

#include "lstm_planner/dataset/drive_recorder.hpp"
#include "lstm_planner/ros/common/scanner_mounts.hpp"

namespace lstm_planner {

/// Tells a DriveRecorder what ROS messages say, the same for topics and for bags. `received` stands in for the stamps
/// of messages that have none. Nothing is thrown: what cannot be used is rejected. Not thread safe.
class DriveMessages {
 public:
  /// `tf` and `sink` must outlive the object; the transforms need not be there yet. `base_frame`: the robot's, where
  /// the odometry does not name it. `mount`: where the scanner sits; empty: from the transforms.
  /// Throws std::invalid_argument for parameters that DriveRecorder refuses.
  DriveMessages(const tf2::BufferCore& tf, const std::string& base_frame, const std::optional<SensorMount>& mount,
                const RecorderParameters& parameters, StepSink* sink);

  void hear(const sensor_msgs::LaserScan& scan, const ros::Time& received);
  void hear(const nav_msgs::Odometry& odometry, const ros::Time& received);

  /// What is said to move_base and by it: a goal, the end of one, the end of one unless it succeeded (arrival is told
  /// by odometry). Ends of other goals than the newest are none of ours.
  void hear(const move_base_msgs::MoveBaseActionGoal& goal, const std::string& source, const ros::Time& received);
  void hear(const actionlib_msgs::GoalID& cancel, const ros::Time& received);
  void hear(const move_base_msgs::MoveBaseActionResult& result, const ros::Time& received);

  /// A goal that is driven to from now on. `source`: Episode::goal_source. The same goal heard twice, as
  /// move_base_simple's from move_base, is one.
  void hearGoal(const geometry_msgs::PoseStamped& goal, const std::string& source, const ros::Time& received);

  DriveRecorder& recorder() { return recorder_; }
  const DriveRecorder& recorder() const { return recorder_; }
  const std::string& odometryFrame() const { return odometry_frame_; }  ///< empty before the first odometry

 private:
  /// The goal that was heard last.
  struct LastGoal {
    GoalInFrame goal;
    std::string source;
    double stamp = 0.0;  ///< s
  };

  std::optional<Pose2> locate(const std::string& frame, double stamp) const;
  const SensorMount* mountOf(const std::string& frame);
  bool isUsable(const DriveEvent& event);
  /// Of a goal that has ended, whether it is the newest.
  bool isOurs(const actionlib_msgs::GoalID& ended) const;
  /// The goal is not driven to any more: cancelled or given up. `stamp`: when.
  void hearEnd(const ros::Time& stamp);
  /// `stamp`, or just behind what was said of goals before: computers' clocks differ, and goals are stamped some time
  /// before they are sent.
  double inOrder(double stamp);
  /// Whether tf has the frame below the odometry's, as those of the robot's parts.
  bool movesWithRobot(const std::string& frame) const;

  const tf2::BufferCore& tf_;
  ScannerMounts mounts_;
  std::string odometry_frame_;
  bool odometry_heard_ = false;
  std::optional<SensorMount> given_mount_;
  std::optional<LastGoal> last_goal_;
  /// move_base's newest. Without an id: its action makes one. Empty: the newest goal is not move_base's.
  actionlib_msgs::GoalID action_goal_;
  double last_word_ = 0.0;  ///< s, what was heard last of goals and their ends
  DriveRecorder recorder_;
};

}  // namespace lstm_planner
