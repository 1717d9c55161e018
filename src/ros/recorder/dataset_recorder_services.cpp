#include <algorithm>
#include <iostream>
#include <sstream>

#include "ros/recorder/dataset_recorder_implementation.hpp"

namespace lstm_planner {

bool DatasetRecorder::Implementation::pause(std_srvs::SetBool::Request& request,
                                            std_srvs::SetBool::Response& response) {
  guarded([&] { messages_.recorder().setPaused(request.data != 0); });
  response.success = static_cast<unsigned char>(messages_.recorder().paused() == (request.data != 0));
  response.message = (messages_.recorder().paused() ? "paused with " : "recording on with ") +
                     std::to_string(progress_.steps()) + " steps";
  publishStatus();
  return true;
}

bool DatasetRecorder::Implementation::discardEpisode(std_srvs::Trigger::Request&,
                                                     std_srvs::Trigger::Response& response) {
  response.success = 0;
  response.message = "there is no episode that is not discarded already";
  guarded([&] {
    if (!progress_.newest() || progress_.newest()->episode.discarded) return;
    DriveRecorder& recorder = messages_.recorder();
    const std::optional<GoalInFrame> goal = recorder.goal();
    const std::string source = progress_.newest()->episode.goal_source;
    if (recorder.inEpisode()) {
      recorder.endEpisode(EpisodeEnd::kAborted);
      if (goal) recorder.add(GoalHeard{goalHeardNow().toSec(), *goal, source});
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

bool DatasetRecorder::Implementation::finishByService(std_srvs::Trigger::Request&,
                                                      std_srvs::Trigger::Response& response) {
  response.message = exit_code_ ? "the recording has ended already" : finish();
  response.success = static_cast<unsigned char>(exit_code_ == 0);
  return true;
}

std::string DatasetRecorder::Implementation::finish() {
  std::ostringstream sentence;
  try {
    messages_.recorder().finish();
    file_.finish();
    exit_code_ = 0;
    if (file_.isOpen()) {
      sentence << progress_.steps() << " steps in " << progress_.episodes() - progress_.discarded()
               << " episodes are in " << file_.path();
    } else {
      sentence << "no odometry was received on " << subscribers_.at(1).getTopic() << ", so there is no file";
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

void DatasetRecorder::Implementation::onTimer(const ros::WallTimerEvent&) {
  constexpr std::size_t kRecent = 10;
  constexpr long kLogPeriod = 10;
  guarded([this] {
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
    problem_.clear();
  });
}

RecordingStatus DatasetRecorder::Implementation::status() const {
  constexpr double kShortestAlarm = 2.0;  // s
  const auto silenceSince = [](const ros::WallTime& last) {
    return last.isZero() ? std::nullopt : std::optional<double>((ros::WallTime::now() - last).toSec());
  };
  RecordingStatus status;
  status.node = ros::this_node::getName().substr(1);
  file_.describe(&status);
  status.problem = problem_;
  status.disk_low = parameters_.disk_low;
  status.message_problem = messages_.problem();
  status.scan_topic = subscribers_.at(0).getTopic();
  status.odometry_topic = subscribers_.at(1).getTopic();
  status.scans_heard = scans_heard_;
  status.odometry_heard = odometry_heard_;
  status.goals_heard = goals_heard_;
  status.scan_silence = silenceSince(last_scan_);
  status.odometry_silence = silenceSince(last_odometry_);
  status.longest_silence = std::max(kShortestAlarm, parameters_.recorder.max_gap);
  status.paused = messages_.recorder().paused();
  status.goal = messages_.recorder().goal();
  status.action_angles = parameters_.recorder.action_angles;
  status.progress = &progress_;
  if (!snapshots_.empty()) {
    const Snapshot& before = snapshots_.front();
    status.recent_steps = progress_.steps() - before.steps;
    for (std::size_t i = 0; i < before.rejections.size(); ++i) {
      status.recent_rejections[i] = progress_.rejections()[i] - before.rejections[i];
    }
  }
  return status;
}

void DatasetRecorder::Implementation::publishStatus() {
  diagnostic_msgs::DiagnosticArray message;
  message.header.stamp = ros::Time::now();
  message.status.push_back(toDiagnostic(status()));
  diagnostics_publisher_.publish(message);
}

}  // namespace lstm_planner
