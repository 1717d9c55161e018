#include "ros/recorder/dataset_recorder_progress.hpp"

#include <numeric>

namespace lstm_planner {

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

void RecordingProgress::discardEpisode() {
  ++discarded_;
  newest_->episode.discarded = true;
  for (const int label : newest_->labels) --labels_.at(static_cast<std::size_t>(label));
}

long RecordingProgress::steps() const { return std::accumulate(labels_.begin(), labels_.end(), 0L); }

}  // namespace lstm_planner
