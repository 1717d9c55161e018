#pragma once

#include <vector>

#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/training/sequence.hpp"

namespace lstm_planner {

/// How recorded drives become what a network learns from.
struct DatasetSequenceParameters {
  PolicyDescription policy;  ///< of the network; its encoder encodes, as it does for the planner
  int sequence_steps = 0;    ///< episodes are cut into pieces of this many steps; 0: not cut
  int burn_in_steps = 0;     ///< steps of the same episode before each piece, with weight 0: they only set the hidden
                             ///< state

  double label_distance = 0.0;  ///< m; see forEachRecordedEpisode()
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const DatasetSequenceParameters& parameters);

/// The description of a network for these recordings, with their range cap, allowed angles, step length and radius.
/// Throws std::invalid_argument if there is no recording, or if they differ.
PolicyDescription policyOf(const Dataset& dataset);

/// Whether scans are needed to encode the dataset for such a network, because it was recorded with another range cap.
bool needsScans(const Dataset& dataset, const PolicyDescription& policy);

/// All episodes that are not discarded, one after the other; no sequence has steps of two episodes. All weights are 1,
/// except those of burn-in steps, which are 0. Throws as forEachRecordedEpisode().
std::vector<Sequence> datasetSequences(const Dataset& dataset, const DatasetSequenceParameters& parameters);

}  // namespace lstm_planner
