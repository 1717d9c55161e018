#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>

#include <algorithm>
#include <csignal>
#include <deque>
#include <functional>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/ros/common/transform_listener.hpp"
#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"
#include "ros/common/node_main.hpp"
#include "ros/common/timing.hpp"
#include "ros/recorder/dataset_recorder_file.hpp"
#include "ros/recorder/dataset_recorder_markers.hpp"
#include "ros/recorder/dataset_recorder_status.hpp"
#include "ros/recorder/drive_topics.hpp"

namespace lstm_planner {

namespace {

const ros::WallDuration kStatusPeriod(1.0);
constexpr double kLongestDelay = 0.5;  // s that odometry is behind the clock, at the most

/// Picks waypoints at random, never the same twice in a row; the same order for the same seed on every machine.
class WaypointPicker {
 public:
  WaypointPicker(const std::vector<NamedPose>& waypoints, int seed)
      : waypoints_(waypoints), random_(static_cast<Random::result_type>(seed)) {}

  bool empty() const { return waypoints_.empty(); }

  /// Requires !empty().
  const NamedPose& next() {
    std::size_t i = uniformIndex(random_, waypoints_.size() - (last_ ? 1 : 0));
    if (last_ && i >= *last_) ++i;
    last_ = i;
    return waypoints_.at(i);
  }

 private:
  std::vector<NamedPose> waypoints_;
  Random random_;
  std::optional<std::size_t> last_;
};

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
/// The file is made when the first odometry is heard: there is none of a robot that was not there. All callbacks come
/// in the thread of run(); none throws.
class DatasetRecorder {
 public:
  explicit DatasetRecorder(const RecorderNodeParameters& parameters);

  /// Records until `stop` is not 0, ROS is shut down or ~finish is called; then all that was heard is written. Returns
  /// the node's exit code: 0, or 1 when the file could not be made or not all steps could be written.
  int run(const volatile std::sig_atomic_t& stop);

 private:
  /// What had been made of the drive at a time.
  struct Snapshot {
    long steps = 0;
    RejectionCounts rejections{};
  };

  void guarded(const std::function<void()>& work);

  void onMessage(const sensor_msgs::LaserScan& scan, const std::function<void()>& hear);
  void onMessage(const nav_msgs::Odometry& odometry, const std::function<void()>& hear);
  /// A goal, or the end of one.
  template <typename Message>
  void onMessage(const Message& message, const std::function<void()>& hear);
  void openFile(const std::string& odometry_frame);
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

  RecordingStatus status_;          ///< what is counted, and what stays as it is
  ros::SteadyTime last_scan_;       ///< zero before the first
  ros::SteadyTime last_odometry_;   ///< zero before the first
  StandingClock clock_;             ///< ROS's
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

DatasetRecorder::DatasetRecorder(const RecorderNodeParameters& parameters)
    : parameters_(parameters),
      file_(parameters),
      progress_(parameters.recorder.action_angles.size()),
      tf_listener_(&tf_),
      messages_(tf_, parameters.base_frame, std::nullopt, parameters.recorder, &progress_),
      waypoints_(parameters.waypoints, parameters.seed),
      markers_(private_node_, parameters.recorder.action_angles) {
  goal_publisher_ = private_node_.advertise<geometry_msgs::PoseStamped>("goal", 10, true);
  diagnostics_publisher_ = node_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);

  subscribers_ = subscribeToDrive(parameters.scan_topic, parameters.odom_topic, {"move_base_simple/goal"}, &messages_,
                                  [this](const auto& message, const auto& hear) { onMessage(message, hear); });
  services_ = {private_node_.advertiseService("pause", &DatasetRecorder::pause, this),
               private_node_.advertiseService("discard_episode", &DatasetRecorder::discardEpisode, this),
               private_node_.advertiseService("finish", &DatasetRecorder::finishByService, this)};
  constexpr double kShortestAlarm = 2.0;  // s
  status_.node = ros::this_node::getName().substr(1);
  status_.disk_low = parameters.disk_low;
  status_.scan_topic = node_.resolveName(parameters.scan_topic);
  status_.odometry_topic = node_.resolveName(parameters.odom_topic);
  status_.longest_silence = std::max(kShortestAlarm, parameters.recorder.max_gap);
  status_.action_angles = parameters.recorder.action_angles;
  status_.progress = &progress_;
  timer_ = private_node_.createWallTimer(kStatusPeriod, &DatasetRecorder::onTimer, this);
}

int DatasetRecorder::run(const volatile std::sig_atomic_t& stop) {
  while (ros::ok() && stop == 0 && !exit_code_) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
  }
  if (!exit_code_) finish();
  publishStatus();
  return *exit_code_;
}

void DatasetRecorder::guarded(const std::function<void()>& work) {
  if (exit_code_) return;
  try {
    work();
  } catch (const std::exception& error) {
    status_.problem = error.what();
    ROS_ERROR_THROTTLE(10.0, "%s", error.what());
  }
}

void DatasetRecorder::onMessage(const sensor_msgs::LaserScan& /*scan*/, const std::function<void()>& hear) {
  guarded([&] {
    ++status_.scans_heard;
    last_scan_ = ros::SteadyTime::now();
    hear();
    afterSensing();
  });
}

void DatasetRecorder::onMessage(const nav_msgs::Odometry& odometry, const std::function<void()>& hear) {
  if (!file_.isOpen() && !exit_code_) openFile(frameName(odometry.header.frame_id));
  guarded([&] {
    ++status_.odometry_heard;
    last_odometry_ = ros::SteadyTime::now();
    odometry_stamp_ = stampOr(odometry.header.stamp, ros::Time::now());
    hear();
    afterSensing();
  });
}

template <typename Message>
void DatasetRecorder::onMessage(const Message& /*message*/, const std::function<void()>& hear) {
  constexpr bool is_goal = std::is_same_v<Message, geometry_msgs::PoseStamped> ||
                           std::is_same_v<Message, move_base_msgs::MoveBaseActionGoal>;
  guarded([&] {
    ++status_.goals_heard;
    if (is_goal) goal_stamp_ = odometry_stamp_;
    hear();
  });
}

void DatasetRecorder::openFile(const std::string& odometry_frame) {
  try {
    file_.open(odometry_frame, &progress_);
    ROS_INFO("recording into %s", file_.path().c_str());
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    exit_code_ = 1;
  }
}

void DatasetRecorder::afterSensing() {
  pickGoal();
  const DriveRecorder& recorder = messages_.recorder();
  if (recorder.situation()) {
    markers_.publish(messages_.odometryFrame(), *recorder.situation(), progress_, recorder.goal());
  }
}

void DatasetRecorder::pickGoal() {
  const DriveRecorder& recorder = messages_.recorder();
  if (waypoints_.empty() || recorder.paused() || recorder.goal() || !file_.isOpen()) return;
  if (ros::Time::now().isZero()) return;  // a simulator's clock has not come yet
  // A goal that was heard is worked on only when everything before it is.
  const double long_ago = parameters_.recorder.delay + kLongestDelay;
  if (!goal_stamp_.isZero() && std::abs((odometry_stamp_ - goal_stamp_).toSec()) <= long_ago) return;

  const NamedPose& waypoint = waypoints_.next();
  goal_stamp_ = odometry_stamp_;
  const geometry_msgs::PoseStamped goal = toMessage(waypoint.pose, parameters_.waypoint_frame, ros::Time::now());
  goal_publisher_.publish(goal);
  messages_.hearGoal(goal, "waypoints", goal.header.stamp);
  ROS_INFO("the next goal is %s at (%.2f, %.2f)", waypoint.name.c_str(), waypoint.pose.x, waypoint.pose.y);
}

bool DatasetRecorder::pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  guarded([&] { messages_.recorder().setPaused(request.data != 0); });
  response.success = static_cast<unsigned char>(messages_.recorder().paused() == (request.data != 0));
  response.message = (messages_.recorder().paused() ? "paused with " : "recording on with ") +
                     std::to_string(progress_.steps()) + " steps";
  publishStatus();
  return true;
}

bool DatasetRecorder::discardEpisode(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  response.success = 0;
  response.message = "there is no episode that is not discarded already";
  guarded([&] {
    if (!progress_.newest() || progress_.newest()->episode.discarded) return;
    DriveRecorder& recorder = messages_.recorder();
    const std::optional<GoalInFrame> goal = recorder.goal();
    const std::string source = progress_.newest()->episode.goal_source;
    if (recorder.inEpisode()) {
      recorder.endEpisode(EpisodeEnd::kAborted);
      // As of the last sample: a goal, or its end, that was just heard and is not worked on yet comes after it.
      goal_stamp_ = odometry_stamp_;
      if (goal) recorder.add(GoalHeard{recorder.situation()->time, *goal, source});
    }
    if (!file_.discardEpisode()) return;
    progress_.discardEpisode();
    response.success = 1;
    response.message = "an episode of " + std::to_string(progress_.newest()->poses.size()) +
                       " steps will not be used for training; " + std::to_string(progress_.steps()) + " steps are left";
  });
  ROS_INFO("%s", response.message.c_str());
  publishStatus();
  return true;
}

bool DatasetRecorder::finishByService(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  response.message = exit_code_ ? "the recording has ended already" : finish();
  response.success = static_cast<unsigned char>(exit_code_ == 0);
  return true;
}

std::string DatasetRecorder::finish() {
  std::ostringstream sentence;
  try {
    messages_.recorder().finish();
    file_.finish();
    exit_code_ = 0;
    if (file_.isOpen()) {
      sentence << progress_.steps() << " steps in " << progress_.episodes() - progress_.discarded()
               << " episodes are in " << file_.path();
    } else {
      sentence << "no odometry was received on " << status_.odometry_topic << ", so there is no file";
    }
    ROS_INFO("finished: %s", sentence.str().c_str());
    // ROS's log is silent once it is shut down, as by rosnode kill.
    if (!ros::ok()) std::cout << "finished: " << sentence.str() << std::endl;
  } catch (const std::exception& error) {
    exit_code_ = 1;
    sentence << error.what();
    ROS_FATAL("%s", error.what());
  }
  return sentence.str();
}

void DatasetRecorder::onTimer(const ros::WallTimerEvent&) {
  constexpr std::size_t kRecent = 10;
  constexpr long kLogPeriod = 10;
  guarded([this] {
    status_.clock_stands = clock_.stands();
    snapshots_.push_back({progress_.steps(), progress_.rejections()});
    if (snapshots_.size() > kRecent) snapshots_.pop_front();
    publishStatus();
    if (++timer_calls_ % kLogPeriod != 0) return;
    const RecordingStatus now = status();
    const std::string line = toLine(now);
    if (toDiagnostic(now).level == diagnostic_msgs::DiagnosticStatus::OK) {
      ROS_INFO("%s", line.c_str());
    } else {
      ROS_WARN("%s", line.c_str());
    }
    status_.problem.clear();
  });
}

RecordingStatus DatasetRecorder::status() const {
  const auto silenceSince = [](const ros::SteadyTime& last) {
    return last.isZero() ? std::nullopt : std::optional<double>((ros::SteadyTime::now() - last).toSec());
  };
  RecordingStatus status = status_;
  file_.describe(&status);
  status.scan_silence = silenceSince(last_scan_);
  status.odometry_silence = silenceSince(last_odometry_);
  status.paused = messages_.recorder().paused();
  status.goal = messages_.recorder().goal();
  if (!snapshots_.empty()) {
    const Snapshot& before = snapshots_.front();
    status.recent_steps = progress_.steps() - before.steps;
    for (std::size_t i = 0; i < before.rejections.size(); ++i) {
      status.recent_rejections[i] = progress_.rejections()[i] - before.rejections[i];
    }
  }
  return status;
}

void DatasetRecorder::publishStatus() {
  diagnostic_msgs::DiagnosticArray message;
  message.header.stamp = ros::Time::now();
  message.status.push_back(toDiagnostic(status()));
  diagnostics_publisher_.publish(message);
}

}  // namespace

}  // namespace lstm_planner

int main(int argc, char** argv) {
  using namespace lstm_planner;
  // What was heard is written and said at the end.
  return runUntilStopped(argc, argv, "dataset_recorder", [](const ros::NodeHandle& node, const auto& stop) {
    return DatasetRecorder(loadRecorderNodeParameters(node)).run(stop);
  });
}
