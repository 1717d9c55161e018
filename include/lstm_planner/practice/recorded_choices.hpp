#pragma once

#include <functional>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/training/gradient.hpp"
#include "lstm_planner/training/sequence.hpp"

namespace lstm_planner {

/// A step of a drive: the network's observation, and what the driver did, or what a teacher would have done.
struct RecordedChoice {
  Observation observation;
  int label = 0;  ///< index of the steering angle; -1: not known
};

/// All steps of an episode as a sequence: steps with a label have the weight 1, the others 0.
Sequence toSequence(const std::vector<RecordedChoice>& episode, const Encoder& encoder);

/// Calls `look` with all steps of each episode that is not discarded, one episode after the other. The previous action
/// is always that of the label of the step before, as it is when the planner drives.
///
/// `label_distance` (m): 0 for labels as they were recorded, from the next step (thesis Eq. 4.1). Otherwise Eq. 4.1
/// with the first later pose of the episode that is at least so far away, or its last: so a planner whose waypoint lies
/// several recorded steps ahead learns the way to there, and not the driver's corrections in between.
///
/// Throws std::invalid_argument if a recording does not fit the policy: the range cap differs and no scans were kept.
void forEachRecordedEpisode(const Dataset& dataset, const PolicyDescription& policy, double label_distance,
                            const std::function<void(const std::vector<RecordedChoice>&)>& look);

/// What the network prefers at each step of the driver's path: a row for each recorded label, a column for each
/// preference. Throws as forEachRecordedEpisode().
ConfusionMatrix preferencesIn(const Dataset& dataset, DrivePolicy policy);

}  // namespace lstm_planner
