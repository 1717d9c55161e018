#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/ros/common/transform_listener.hpp"
#include "lstm_planner/ros/recorder/drive_messages.hpp"
#include "ros/recorder/dataset_recorder.hpp"
#include "ros/recorder/dataset_recorder_file.hpp"
#include "ros/recorder/dataset_recorder_markers.hpp"
#include "ros/recorder/dataset_recorder_progress.hpp"
#include "ros/recorder/dataset_recorder_status.hpp"
#include "ros/recorder/dataset_recorder_waypoints.hpp"

namespace lstm_planner {

/// All callbacks come in the thread of run(); none throws.
class DatasetRecorder::Implementation {
 public:
  explicit Implementation(const RecorderNodeParameters& parameters);
  int run(const volatile std::sig_atomic_t& stop);

 private:
  /// What had been made of the drive at a time.
  struct Snapshot {
    long steps = 0;
    RejectionCounts rejections{};
  };

  void guarded(const std::function<void()>& work);

  void onScan(const sensor_msgs::LaserScan::ConstPtr& scan);
  void onOdometry(const nav_msgs::Odometry::ConstPtr& odometry);
  void onActionGoal(const move_base_msgs::MoveBaseActionGoal::ConstPtr& goal);
  void onSimpleGoal(const geometry_msgs::PoseStamped::ConstPtr& goal);
  void onCancel(const actionlib_msgs::GoalID::ConstPtr& cancel);
  void onResult(const move_base_msgs::MoveBaseActionResult::ConstPtr& result);
  void openFile(const std::string& odometry_frame);
  ros::Time goalHeardNow();
  void afterSensing();
  void pickGoal();

  bool pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool discardEpisode(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool finishByService(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  std::string finish();

  void onTimer(const ros::WallTimerEvent& event);
  RecordingStatus status() const;
  void publishStatus();

  RecorderNodeParameters parameters_;
  RecorderFile file_;
  RecordingProgress progress_;
  tf2_ros::Buffer tf_;
  TransformListener tf_listener_;
  DriveMessages messages_;
  WaypointPicker waypoints_;
  std::optional<int> exit_code_;  ///< once nothing is recorded any more
  std::string problem_;           ///< what nobody expected to go wrong

  long scans_heard_ = 0;
  long odometry_heard_ = 0;
  long goals_heard_ = 0;            ///< and their ends
  ros::WallTime last_scan_;         ///< zero before the first
  ros::WallTime last_odometry_;     ///< zero before the first
  ros::Time odometry_stamp_;        ///< of the newest
  ros::Time goal_stamp_;            ///< of the newest odometry when the newest goal was heard
  std::deque<Snapshot> snapshots_;  ///< of the last ten seconds, one a second
  long timer_calls_ = 0;

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  RecorderMarkers markers_;
  ros::Publisher goal_publisher_;
  ros::Publisher diagnostics_publisher_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  ros::WallTimer timer_;
};

}  // namespace lstm_planner
