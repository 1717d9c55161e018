#pragma once

#include <algorithm>
#include <cstddef>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// Calls work(recording, episode, step) for each step that is to be learned from; episodes are counted over all
/// recordings, from 0, the discarded ones too.
template <typename Work>
void forEachStep(const Dataset& dataset, Work&& work) {
  long recording_index = 0;
  long episode_index = 0;
  for (const Recording& recording : dataset.recordings) {
    for (const RecordedEpisode& episode : recording.episodes) {
      if (!episode.episode.discarded) {
        for (const DriveStep& step : episode.steps) work(recording_index, episode_index, step);
      }
      ++episode_index;
    }
    ++recording_index;
  }
}

/// Of the longest scan.
inline std::size_t mostBeams(const Dataset& dataset) {
  std::size_t beams = 0;
  forEachStep(dataset, [&](long, long, const DriveStep& step) { beams = std::max(beams, step.ranges.size()); });
  return beams;
}

}  // namespace lstm_planner
