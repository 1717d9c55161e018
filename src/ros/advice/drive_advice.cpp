#include "lstm_planner/ros/advice/drive_advice.hpp"

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>

#include <csignal>
#include <exception>
#include <string>
#include <vector>

#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/practice/decision_replay.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"
#include "lstm_planner/ros/common/transform_listener.hpp"
#include "lstm_planner/ros/replay/decision_display.hpp"
#include "ros/common/node_main.hpp"
#include "ros/recorder/drive_topics.hpp"

namespace lstm_planner {
namespace {

using diagnostic_msgs::DiagnosticStatus;

RecorderParameters stepParameters(const PolicyDescription& description, const DriveAdviceParameters& parameters) {
  const SensorParameters& sensors = parameters.planner.sensors;
  RecorderParameters steps = replayParameters(description, parameters.planner.agent, sensors.scan_rules);
  steps.delay = parameters.delay;
  steps.max_speed = sensors.max_speed;
  return steps;
}

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

  /// Advises until `stop` is not 0 or ROS is shut down; says then how often driver and planner agreed. Throws when the
  /// file of decisions cannot be written.
  void run(const volatile std::sig_atomic_t& stop);

 private:
  void startEpisode(const Episode& episode) override;
  void startStep(const DriveStep& step) override;
  void addStep(const DriveStep& step) override;
  void endEpisode(double stamp, EpisodeEnd end) override;
  void reject(Rejection rejection) override;

  void publishAgreement();

  DriveAdviceParameters parameters_;
  DecisionReplay replay_;
  tf2_ros::Buffer tf_;
  TransformListener tf_listener_;
  DriveMessages messages_;
  DecisionDisplay display_;
  ros::Publisher agreement_;
  std::vector<ros::Subscriber> subscribers_;
};

DriveAdvice::DriveAdvice(const DriveAdviceParameters& parameters)
    : parameters_(parameters),
      replay_(DrivePolicy::fromFile(resolvedPath(parameters.planner.model)), parameters.planner.agent,
              parameters.planner.sensors.scan_rules),
      tf_listener_(&tf_),
      messages_(tf_, parameters.base_frame, std::nullopt, stepParameters(replay_.description(), parameters), this),
      display_(replay_.description()),
      agreement_(ros::NodeHandle("~").advertise<DiagnosticStatus>("agreement", 1, true)),
      subscribers_(subscribeToDrive(parameters.planner.sensors.scan_topic, parameters.planner.sensors.odom_topic,
                                    {"move_base_simple/goal", parameters.goal_topic}, &messages_,
                                    [](const auto& /*message*/, const auto& hear) {
                                      try {
                                        hear();
                                      } catch (const std::exception& error) {
                                        ROS_ERROR_THROTTLE(10.0, "%s", error.what());
                                      }
                                    })) {}

void DriveAdvice::run(const volatile std::sig_atomic_t& stop) {
  while (ros::ok() && stop == 0) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
  }
  messages_.recorder().finish();
  ROS_INFO("in all: %s", describeReplay(replay_).c_str());
  if (parameters_.decisions.empty()) return;
  writeOutputFile("file", parameters_.decisions,
                  [this](std::ostream& file) { writeDecisions(replay_.decisions(), &file); });
}

void DriveAdvice::startEpisode(const Episode& episode) {
  replay_.startEpisode(episode);
  display_.clearPath();
}

void DriveAdvice::startStep(const DriveStep& step) {
  replay_.advise(step);
  display_.showAdvice(*replay_.advice(), messages_.odometryFrame());
}

void DriveAdvice::addStep(const DriveStep& step) {
  replay_.addStep(step);
  display_.showDriver(replay_.decisions().back(), messages_.odometryFrame());
  publishAgreement();
}

void DriveAdvice::endEpisode(double stamp, EpisodeEnd end) {
  replay_.endEpisode(stamp, end);
  ROS_INFO("the drive has ended (%s); so far %s", toString(end), describeReplay(replay_).c_str());
}

void DriveAdvice::reject(Rejection rejection) {
  replay_.reject(rejection);
  const bool is_unusable = rejection == Rejection::kNoOdometry || rejection == Rejection::kNoTransform ||
                           rejection == Rejection::kUnusableScan || rejection == Rejection::kNotFinite ||
                           rejection == Rejection::kLate;
  if (is_unusable && !messages_.odometryFrame().empty()) {
    ROS_WARN_THROTTLE(10.0, "no decision about the newest messages: %s", toString(rejection));
  }
}

void DriveAdvice::publishAgreement() {
  const Agreement agreement = agreementOf(replay_.decisions());
  const auto share = [](long count, long all) {
    return all > 0 ? static_cast<double>(count) / static_cast<double>(all) : 0.0;
  };
  diagnostic_updater::DiagnosticStatusWrapper status;
  const auto add = [&status](const std::string& key, double value) { status.add(key, numberText(value)); };
  status.name = "drive_advice: agreement";
  status.message = describeReplay(replay_);
  add("decisions", static_cast<double>(agreement.decisions));
  add("same", static_cast<double>(agreement.same_action));
  add("accuracy", share(agreement.same_action, agreement.decisions));
  add("balanced", agreement.balanced);
  add("majority", agreement.majority);
  add("majority_balanced", agreement.majority_balanced);
  add("mean_difference", agreement.mean_difference);
  add("network", share(agreement.preferred, agreement.asked));
  agreement_.publish(static_cast<const DiagnosticStatus&>(status));
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected, and as checkWritable().
DriveAdviceParameters loadDriveAdviceParameters(const ros::NodeHandle& private_node) {
  DriveAdviceParameters parameters;
  ParameterReader reader(private_node);
  visitDriveAdviceParameters(parameters, reader.visitor());
  reader.knowRobotFile();
  reader.warnOfUnknown();
  parameters.planner = loadGlobalPlannerParameters(ros::NodeHandle(private_node, "LstmGlobalPlanner"));
  parameters.decisions = resolvedPath(parameters.decisions);
  if (!parameters.decisions.empty()) checkWritable(parameters.decisions);
  return parameters;
}

}  // namespace
}  // namespace lstm_planner

int main(int argc, char** argv) {
  using namespace lstm_planner;
  // How often both agreed is said at the end.
  return runUntilStopped(argc, argv, "drive_advice", [](const ros::NodeHandle& node, const auto& stop) {
    DriveAdvice(loadDriveAdviceParameters(node)).run(stop);
    return 0;
  });
}
