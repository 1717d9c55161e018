#pragma once

#include <vector>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// Keeps what a recorder makes.
class StepList : public StepSink {
 public:
  void beginEpisode(const Episode& episode) override { episodes.push_back({episode, {}}); }
  void addStep(const DriveStep& step) override { episodes.back().steps.push_back(step); }
  void endEpisode(double stamp, EpisodeEnd end) override {
    episodes.back().episode.ended = stamp;
    episodes.back().episode.end = end;
  }
  void reject(Rejection rejection) override { ++rejections[static_cast<std::size_t>(rejection)]; }

  long rejected(Rejection rejection) const { return rejections[static_cast<std::size_t>(rejection)]; }

  std::vector<RecordedEpisode> episodes;
  RejectionCounts rejections{};
};

}  // namespace lstm_planner
