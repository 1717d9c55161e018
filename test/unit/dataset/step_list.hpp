#pragma once

#include <map>
#include <string>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// Keeps what a recorder makes, whatever the recording is.
class StepList : public RecordingSink {
 public:
  StepList() : RecordingSink({}) {}
  const std::vector<RecordedEpisode>& episodes() const { return recording().episodes; }
  const RejectionCounts& rejections() const { return recording().rejections; }
  long rejected(Rejection rejection) const { return rejections()[static_cast<std::size_t>(rejection)]; }
  /// The last one that was told; empty if there is none.
  std::string reason(Rejection rejection) const {
    const auto reason = reasons_.find(rejection);
    return reason == reasons_.end() ? "" : reason->second;
  }

  void explain(Rejection rejection, const std::string& why) override { reasons_[rejection] = why; }

 private:
  std::map<Rejection, std::string> reasons_;
};

}  // namespace lstm_planner
