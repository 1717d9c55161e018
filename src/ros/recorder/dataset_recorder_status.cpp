#include "ros/recorder/dataset_recorder_status.hpp"

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <sstream>

#include "lstm_planner/common/text_table.hpp"
#include "ros/common/timing.hpp"

namespace lstm_planner {

namespace {

using diagnostic_msgs::DiagnosticStatus;

struct Verdict {
  unsigned char level;
  std::string text;
};

std::string degrees(double radians) { return std::to_string(std::lround(radians * 180.0 / M_PI)); }

std::string describe(const GoalInFrame& goal) {
  return "(" + fixedText(goal.pose.x, 2) + ", " + fixedText(goal.pose.y, 2) + ") in " + goal.frame;
}

std::string describeSilence(const std::string& what, const std::string& topic, const std::optional<double>& silence) {
  return silence ? "no " + what + " on " + topic + " for " + fixedText(*silence, 1) + " s"
                 : "no " + what + " on " + topic + " yet";
}

bool isSilent(const std::optional<double>& silence, double longest) { return !silence || *silence > longest; }

/// Reasons that say something is wrong, rather than that the driver rests.
bool isTrouble(Rejection rejection) {
  return rejection != Rejection::kStanding && rejection != Rejection::kPaused && rejection != Rejection::kNoNextStep;
}

std::string describeRejection(Rejection rejection, const RecordingStatus& status) {
  if (rejection == Rejection::kNoGoal) return "no goal is set (rviz: 2D Nav Goal)";
  const bool has_sentence = rejection == Rejection::kNoTransform || rejection == Rejection::kNotFinite;
  return has_sentence ? status.progress->reason(rejection) : toString(rejection);
}

/// When for a while there was nothing but rejections: why.
std::optional<std::string> uselessness(const RecordingStatus& status) {
  if (status.recent_steps > 0) return std::nullopt;
  RejectionCounts troubles = status.recent_rejections;
  for (int i = 0; i < kRejectionCount; ++i) {
    const auto rejection = static_cast<Rejection>(i);
    const bool mended = rejection == Rejection::kNoGoal && status.goal;
    if (mended || !isTrouble(rejection)) troubles[static_cast<std::size_t>(i)] = 0;
  }
  const auto most = std::max_element(troubles.begin(), troubles.end());
  if (*most == 0) return std::nullopt;
  return "no steps are recorded: " +
         describeRejection(static_cast<Rejection>(std::distance(troubles.begin(), most)), status);
}

Verdict judge(const RecordingStatus& status) {
  if (!status.write_problem.empty()) {
    return {DiagnosticStatus::ERROR,
            "cannot write (" + std::to_string(status.waiting) + " steps are waiting): " + status.write_problem};
  }
  if (!status.problem.empty()) return {DiagnosticStatus::ERROR, status.problem};
  if (status.lost > 0) return {DiagnosticStatus::ERROR, std::to_string(status.lost) + " steps could not be written"};
  const bool is_odometry_silent = isSilent(status.odometry_silence, status.longest_silence);
  const bool is_scan_silent = isSilent(status.scan_silence, status.longest_silence);
  if (status.clock_stands && (is_odometry_silent || is_scan_silent)) {
    return {DiagnosticStatus::WARN, StandingClock::kText};
  }
  if (is_odometry_silent) {
    return {DiagnosticStatus::WARN, describeSilence("odometry", status.odometry_topic, status.odometry_silence)};
  }
  if (is_scan_silent) {
    return {DiagnosticStatus::WARN, describeSilence("scan", status.scan_topic, status.scan_silence)};
  }
  if (status.disk_left < status.disk_low) {
    return {DiagnosticStatus::WARN, "only " + fixedText(status.disk_left, 0) + " MB are left on the disk"};
  }
  if (status.paused) return {DiagnosticStatus::OK, "paused"};
  if (const auto reason = uselessness(status)) return {DiagnosticStatus::WARN, *reason};
  return {DiagnosticStatus::OK, "recording"};
}

}  // namespace

DiagnosticStatus toDiagnostic(const RecordingStatus& status) {
  const Verdict verdict = judge(status);
  const RecordingProgress& progress = *status.progress;
  diagnostic_updater::DiagnosticStatusWrapper message;
  message.name = status.node + ": recording";
  message.summary(verdict.level, verdict.text);
  message.add("file", status.file);
  message.add("paused", status.paused ? "yes" : "no");
  message.add("goal", status.goal ? describe(*status.goal) : "none");
  message.add("steps", progress.steps());
  message.add("steps stored", status.stored);
  message.add("steps waiting", status.waiting);
  message.add("steps lost", status.lost);
  message.add("episodes", progress.episodes());
  message.add("episodes arrived", progress.arrived());
  message.add("episodes discarded", progress.discarded());
  for (std::size_t i = 0; i < status.action_angles.size(); ++i) {
    message.add("label " + degrees(status.action_angles[i]), progress.labels().at(i));
  }
  for (int i = 0; i < kRejectionCount; ++i) {
    message.add("rejected: " + std::string(toString(static_cast<Rejection>(i))),
                progress.rejections()[static_cast<std::size_t>(i)]);
  }
  message.add("scans heard", status.scans_heard);
  message.add("odometry heard", status.odometry_heard);
  message.add("goals heard", status.goals_heard);
  message.add("disk left (MB)", fixedText(status.disk_left, 0));
  message.add("problem", status.write_problem.empty() ? status.problem : status.write_problem);
  return message;
}

std::string toLine(const RecordingStatus& status) {
  const RecordingProgress& progress = *status.progress;
  std::ostringstream line;
  line << judge(status).text << ": " << progress.steps() << " steps in " << progress.episodes() << " episodes";
  const char* separator = " (";
  for (std::size_t i = 0; i < status.action_angles.size(); ++i) {
    line << separator << degrees(status.action_angles[i]) << ": " << progress.labels().at(i);
    separator = ", ";
  }
  line << (status.action_angles.empty() ? "" : ")");
  const std::string rejected = textOf(progress.rejections());
  line << (rejected.empty() ? "" : "; rejected: ") << rejected << "; goal "
       << (status.goal ? describe(*status.goal) : "none") << "; " << fixedText(status.disk_left / 1000.0, 1)
       << " GB left";
  return line.str();
}

void RecordingProgress::passTo(StepSink* sink) {
  sink_ = sink;
  for (int i = 0; i < kRejectionCount; ++i) {
    for (long n = rejections_[static_cast<std::size_t>(i)]; n > 0; --n) sink_->reject(static_cast<Rejection>(i));
  }
}

void RecordingProgress::startEpisode(const Episode& episode) {
  ++episodes_;
  newest_ = EpisodeProgress{episode, {}, {}};
  if (sink_ != nullptr) sink_->startEpisode(episode);
}

void RecordingProgress::addStep(const DriveStep& step) {
  newest_->poses.push_back(step.pose);
  newest_->labels.push_back(step.label);
  if (!newest_->episode.discarded) ++labels_.at(static_cast<std::size_t>(step.label));
  if (sink_ != nullptr) sink_->addStep(step);
}

void RecordingProgress::endEpisode(double stamp, EpisodeEnd end) {
  newest_->episode.ended = stamp;
  newest_->episode.end = end;
  if (end == EpisodeEnd::kArrived) ++arrived_;
  if (sink_ != nullptr) sink_->endEpisode(stamp, end);
}

void RecordingProgress::reject(Rejection rejection) {
  ++rejections_.at(static_cast<std::size_t>(rejection));
  if (sink_ != nullptr) sink_->reject(rejection);
}

std::string RecordingProgress::reason(Rejection rejection) const {
  const auto found = reasons_.find(rejection);
  return found == reasons_.end() ? toString(rejection) : found->second;
}

void RecordingProgress::discardEpisode() {
  ++discarded_;
  newest_->episode.discarded = true;
  for (const int label : newest_->labels) --labels_.at(static_cast<std::size_t>(label));
}

long RecordingProgress::steps() const { return std::accumulate(labels_.begin(), labels_.end(), 0L); }

}  // namespace lstm_planner
