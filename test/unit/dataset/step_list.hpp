#pragma once

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// Keeps what a recorder makes, whatever the recording is.
class StepList : public RecordingSink {
 public:
  StepList() : RecordingSink({}) {}
  const std::vector<RecordedEpisode>& episodes() const { return recording().episodes; }
  const RejectionCounts& rejections() const { return recording().rejections; }
  long rejected(Rejection rejection) const { return rejections()[static_cast<std::size_t>(rejection)]; }
};

}  // namespace lstm_planner
