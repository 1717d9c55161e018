#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/dataset/drive_step.hpp"
#include "lstm_planner/drive/decision/goal_tracker.hpp"

namespace lstm_planner {

/// Counts what becomes of a recording and passes it on.
class RecordingProgress : public StepSink {
 public:
  struct EpisodeProgress {
    Episode episode;
    std::vector<Pose2> poses;  ///< of its steps, odometry frame
    std::vector<int> labels;   ///< of its steps
  };

  /// `labels`: how many there are.
  explicit RecordingProgress(std::size_t labels) : labels_(labels, 0) {}

  /// Whom all is passed on to; must outlive the object. Rejections of before are made up for.
  void passTo(StepSink* sink);

  void startEpisode(const Episode& episode) override;
  void addStep(const DriveStep& step) override;
  void endEpisode(double stamp, EpisodeEnd end) override;
  void reject(Rejection rejection) override;
  void explain(Rejection rejection, const std::string& why) override { reasons_[rejection] = why; }

  /// The newest episode was discarded: its steps do not count.
  void discardEpisode();

  long steps() const;                                          ///< without those of discarded episodes
  const std::vector<long>& labels() const { return labels_; }  ///< of these steps, by label
  const RejectionCounts& rejections() const { return rejections_; }
  /// Why something was last rejected so; the kind's name where more was not said.
  std::string reason(Rejection rejection) const;
  long episodes() const { return episodes_; }
  long arrived() const { return arrived_; }      ///< episodes that ended at the goal, discarded or not
  long discarded() const { return discarded_; }  ///< episodes
  const std::optional<EpisodeProgress>& newest() const { return newest_; }  ///< running or ended

 private:
  StepSink* sink_ = nullptr;
  std::vector<long> labels_;
  RejectionCounts rejections_{};
  std::map<Rejection, std::string> reasons_;  ///< the last ones
  long episodes_ = 0;
  long arrived_ = 0;
  long discarded_ = 0;
  std::optional<EpisodeProgress> newest_;
};

/// What a driver wants to know of the recording, at one moment.
struct RecordingStatus {
  std::string node;  ///< its name
  std::string file;
  long stored = 0;            ///< steps that are on the disk, also those of discarded episodes
  long waiting = 0;           ///< steps that could not be written yet
  long lost = 0;              ///< steps that were given up
  double disk_left = 0.0;     ///< MB
  double disk_low = 0.0;      ///< MB, less than this is low
  std::string write_problem;  ///< why steps are waiting
  std::string problem;        ///< what nobody expected to go wrong

  std::string scan_topic;
  std::string odometry_topic;
  long scans_heard = 0;
  long odometry_heard = 0;
  long goals_heard = 0;                    ///< and their ends
  std::optional<double> scan_silence;      ///< s of the computer's clock since the last; empty: there was none
  std::optional<double> odometry_silence;  ///< the same
  double longest_silence = 0.0;            ///< s that are nothing to worry about
  bool clock_stands = false;               ///< ROS's; then a simulator sends nothing

  bool paused = false;
  std::optional<GoalInFrame> goal;
  std::vector<double> action_angles;  ///< rad
  const RecordingProgress* progress = nullptr;
  long recent_steps = 0;                ///< in the last ten seconds
  RejectionCounts recent_rejections{};  ///< the same
};

/// Level, a sentence, and every number by its name.
diagnostic_msgs::DiagnosticStatus toDiagnostic(const RecordingStatus& status);

/// The same in short.
std::string toLine(const RecordingStatus& status);

}  // namespace lstm_planner
