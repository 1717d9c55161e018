#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/time.h>
#include <tf2_ros/buffer.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/drive/collision/shield.hpp"
#include "lstm_planner/drive/motion/idle_watch.hpp"
#include "lstm_planner/drive/motion/path_tracker.hpp"
#include "lstm_planner/drive/perception/out_of_view.hpp"
#include "lstm_planner/drive/perception/period_meter.hpp"
#include "lstm_planner/drive/perception/situation.hpp"
#include "lstm_planner/drive/plugin_parameters.hpp"
#include "ros/common/costmap_reader.hpp"
#include "ros/common/frame_transformer.hpp"
#include "ros/common/message_queue.hpp"
#include "ros/common/sensor_listener.hpp"
#include "ros/common/tf_check.hpp"

namespace lstm_planner {

/// The plan has not been renewed for too long.
class OutdatedPlan : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Follows a plan by scan and odometry: what SteeringController does once it is initialised. Not thread safe.
class PlanFollower {
 public:
  /// `base_frame`: the robot's, where the odometry does not name it. `tf` must outlive the object. `costmap`: null
  /// where there is none.
  PlanFollower(const SteeringControllerParameters& parameters, const std::string& base_frame, const tf2_ros::Buffer& tf,
               costmap_2d::Costmap2DROS* costmap = nullptr);

  /// Throws std::invalid_argument when the poses are not finite or not all in one named frame; the last plan is then
  /// forgotten.
  void setPlan(const std::vector<geometry_msgs::PoseStamped>& plan);
  bool hasPlan() const { return !plan_.empty(); }

  /// The next command, or why there is none. Throws SensorError, UnusableScan, FrameError or OutdatedPlan when it is
  /// not safe to move. Zero without a plan.
  MotionCommand compute();

  /// Throws as compute().
  bool goalReached();

  /// From the next command on: what moves the robot; not the sensors. Throws std::invalid_argument for what
  /// needs a restart, or as MotionController.
  void change(const SteeringControllerParameters& parameters);
  const SteeringControllerParameters& parameters() const { return parameters_; }

  SensorListener& sensors() { return sensors_; }

  /// `why`, and what more is known of it: returns inside the footprint, or the distance of an obstacle of the costmap
  /// that the scan does not show, if it is the nearest one.
  std::string whatBlocks(const std::string& why) const;
  /// How long it has been told to move, and does not; empty where it does.
  std::string whyIdle() const;
  /// Measured at the last command, m/s, 0 or more.
  double speed() const { return speed_; }

 private:
  void checkPlanAge(const ros::Time& now) const;
  Pose2 odometryFromPlan(const std::string& odometry_frame, const ros::Time& now) const;
  void perceive(const SensorReading& reading, const ros::Time& now);
  void sayDelay();

  SteeringControllerParameters parameters_;
  double reach_;  ///< m, within which obstacles are looked at
  FrameTransformer frames_;
  MessageQueue messages_;
  SensorListener sensors_;
  TfCheck tf_check_;
  CostmapReader costmap_;
  PathTracker tracker_;
  IdleWatch idle_;
  PeriodMeter asked_;
  Shield shield_;
  OutOfView out_of_view_;      ///< of a robot with corners
  std::vector<Point2> known_;  ///< returns of this scan and of earlier ones, as seen from the newest pose, m

  ros::Time plan_time_;  ///< when the plan was set
  std::string plan_frame_;
  std::vector<Pose2> plan_;         ///< plan's frame
  Situation seen_;                  ///< by the scans of the current call
  std::vector<Point2> marked_;      ///< of the costmap, not of the scans; base frame, m
  double speed_ = 0.0;              ///< m/s
  double told_delay_ = 0.0;         ///< s, of the base; the longest that was said
  long jumps_ = 0;                  ///< of the odometry, until the last call
  std::optional<long> plan_jumps_;  ///< the same when the plan was followed first
};

}  // namespace lstm_planner
