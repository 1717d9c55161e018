#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

long stepCount(const Dataset& dataset) {
  long count = 0;
  for (const Recording& recording : dataset.recordings) {
    for (const RecordedEpisode& recorded : recording.episodes) {
      if (!recorded.episode.discarded) count += static_cast<long>(recorded.steps.size());
    }
  }
  return count;
}

}  // namespace lstm_planner
