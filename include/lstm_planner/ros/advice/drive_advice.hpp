#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/buffer.h>

#include <csignal>
#include <functional>
#include <string>
#include <vector>

#include "lstm_planner/practice/decision_replay.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/common/transform_listener.hpp"
#include "lstm_planner/ros/recorder/drive_messages.hpp"
#include "lstm_planner/ros/replay/decision_display.hpp"

namespace lstm_planner {

/// What `drive_advice` reads from its private namespace; launch/advice.launch has an argument for each.
struct DriveAdviceParameters {
  GlobalPlannerParameters planner;  ///< ~LstmGlobalPlanner/...: as in move_base
  std::string base_frame = "base_footprint";
  std::string goal_topic = "dataset_recorder/goal";
  double delay = 0.1;
  std::string decisions;
};

/// Visits every parameter but those of the planner; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitDriveAdviceParameters(Parameters& advice, const Visitor& visit) {
  visit("base_frame", advice.base_frame, {}, "", "the robot's frame, if the odometry does not name it");
  visit("goal_topic", advice.goal_topic, {}, "",
        "geometry_msgs/PoseStamped, in addition to move_base_simple/goal and move_base/goal");
  visit("delay", advice.delay, {0.0, 10.0}, "s",
        "how long to wait for late messages before messages with later stamps are processed");
  visit("decisions", advice.decisions, {}, "", "path of a CSV file for the decisions, written at the end; empty: none");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
DriveAdviceParameters loadDriveAdviceParameters(const ros::NodeHandle& private_node);

/// The node `drive_advice`: the planner answers at every step while somebody else drives (thesis 4.2, Figures 4.11 to
/// 4.13). It publishes no command.
///
/// Subscribed topics: scan and odometry of the planner's parameters, tf, and goals and their ends as dataset_recorder.
///
/// Published topics:
///  - those of DecisionDisplay: the advice as soon as a step begins, the driver's angle when the next one does
///  - `~agreement` (diagnostic_msgs/DiagnosticStatus, latched), once a step: decisions, same, accuracy, balanced,
///    majority, majority_balanced (shares), mean_difference (rad), network (of the steps at which it was asked, the
///    share where it preferred the driver's angle)
class DriveAdvice : private StepSink {
 public:
  /// Throws when the model cannot be used with these parameters.
  explicit DriveAdvice(const DriveAdviceParameters& parameters);

  /// Advises until `stop` is not 0 or ROS is shut down; says then how often driver and planner agreed. Returns the
  /// node's exit code: 0, or 1 when the file of decisions could not be written.
  int run(const volatile std::sig_atomic_t& stop);

 private:
  void startEpisode(const Episode& episode) override;
  void startStep(const DriveStep& step) override;
  void addStep(const DriveStep& step) override;
  void endEpisode(double stamp, EpisodeEnd end) override;
  void reject(Rejection rejection) override;

  template <typename Message>
  void subscribe(const std::string& topic, int queue,
                 const std::function<void(const Message&, const ros::Time&)>& hear);
  void publishAgreement();

  DriveAdviceParameters parameters_;
  DecisionReplay replay_;
  tf2_ros::Buffer tf_;
  TransformListener tf_listener_;
  DriveMessages messages_;
  DecisionDisplay display_;
  ros::NodeHandle node_;
  ros::Publisher agreement_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace lstm_planner
