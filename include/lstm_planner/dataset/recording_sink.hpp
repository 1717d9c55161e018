#pragma once

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// Keeps what a recorder makes in memory.
class RecordingSink : public StepSink {
 public:
  explicit RecordingSink(const RecordingDescription& description) { recording_.description = description; }

  void startEpisode(const Episode& episode) override { recording_.episodes.push_back({episode, {}}); }
  void addStep(const DriveStep& step) override { recording_.episodes.back().steps.push_back(step); }
  void endEpisode(double stamp, EpisodeEnd end) override {
    recording_.episodes.back().episode.ended = stamp;
    recording_.episodes.back().episode.end = end;
  }
  void reject(Rejection rejection) override { ++recording_.rejections[static_cast<std::size_t>(rejection)]; }

  Recording& recording() { return recording_; }
  const Recording& recording() const { return recording_; }

 private:
  Recording recording_;
};

}  // namespace lstm_planner
