#pragma once

#include <optional>
#include <vector>

#include "lstm_planner/dataset/drive_step.hpp"

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

  /// The newest episode was discarded: its steps do not count.
  void discardEpisode();

  long steps() const;                                          ///< without those of discarded episodes
  const std::vector<long>& labels() const { return labels_; }  ///< of these steps, by label
  const RejectionCounts& rejections() const { return rejections_; }
  long episodes() const { return episodes_; }
  long arrived() const { return arrived_; }      ///< episodes that ended at the goal, discarded or not
  long discarded() const { return discarded_; }  ///< episodes
  const std::optional<EpisodeProgress>& newest() const { return newest_; }  ///< running or ended

 private:
  StepSink* sink_ = nullptr;
  std::vector<long> labels_;
  RejectionCounts rejections_{};
  long episodes_ = 0;
  long arrived_ = 0;
  long discarded_ = 0;
  std::optional<EpisodeProgress> newest_;
};

}  // namespace lstm_planner
