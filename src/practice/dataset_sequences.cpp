#include "lstm_planner/practice/dataset_sequences.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/practice/recorded_choices.hpp"
#include "practice/recording_comparison.hpp"

namespace lstm_planner {
namespace {

/// All in one piece where they say 0 steps.
SequenceCut cutOf(const DatasetSequenceParameters& parameters) {
  const Eigen::Index steps =
      parameters.sequence_steps > 0 ? parameters.sequence_steps : std::numeric_limits<Eigen::Index>::max() / 2;
  return {steps, steps, parameters.burn_in_steps};
}

}  // namespace

void validate(const DatasetSequenceParameters& parameters) {
  checkParameter(parameters.sequence_steps >= 0, "sequence_steps", parameters.sequence_steps, "zero or more");
  checkParameter(parameters.burn_in_steps >= 0, "burn_in_steps", parameters.burn_in_steps, "zero or more");
  checkParameter(parameters.label_distance >= 0.0, "label_distance", parameters.label_distance, "zero or more");
  validate(parameters.policy.encoder);
  checkParameter(parameters.policy.encoder.views == 1, "views", parameters.policy.encoder.views,
                 "1: eight views learn from recordings while they practise (--method actor-critic --recordings)");
}

PolicyDescription policyOf(const Dataset& dataset) {
  if (dataset.recordings.empty()) throw std::invalid_argument("the dataset has no recording, expected at least one");
  const RecorderParameters& first = dataset.recordings.front().description.parameters;
  for (const Recording& recording : dataset.recordings) {
    const RecorderParameters& other = recording.description.parameters;
    const auto require = [&](bool same, const char* what) {
      if (same) return;
      throw std::invalid_argument(nameOf(recording) + " and " + nameOf(dataset.recordings.front()) + " differ in " +
                                  what + ", expected recordings of one robot");
    };
    require(isSameRange(other.range_cap, first.range_cap), "range_cap");
    require(isSame(other.action_angles, first.action_angles), "action_angles");
    require(isSameRange(other.agent.step.length, first.agent.step.length), "step/length");
    require(isSameRange(other.agent.shield.footprint_radius, first.agent.shield.footprint_radius),
            "shield/footprint_radius");
  }
  PolicyDescription policy;
  policy.encoder.range_cap = first.range_cap;
  // The thesis's angles are taken from ActionSet: a file has fewer digits.
  if (!isSame(first.action_angles, policy.actions.angles())) policy.actions = ActionSet(first.action_angles);
  policy.step_length = first.agent.step.length;
  policy.footprint_radius = first.agent.shield.footprint_radius;
  return policy;
}

bool needsScans(const Dataset& dataset, const PolicyDescription& policy) {
  return std::any_of(dataset.recordings.begin(), dataset.recordings.end(), [&](const Recording& recording) {
    return !isSameRange(recording.description.parameters.range_cap, policy.encoder.range_cap);
  });
}

std::vector<Sequence> datasetSequences(const Dataset& dataset, const DatasetSequenceParameters& parameters) {
  validate(parameters);
  const Encoder encoder(parameters.policy.encoder);
  std::vector<Sequence> sequences;
  forEachRecordedEpisode(dataset, parameters.policy, parameters.label_distance,
                         [&](const std::vector<RecordedChoice>& episode) {
                           cutIntoPieces(toSequence(episode, encoder), cutOf(parameters), &sequences);
                         });
  return sequences;
}

}  // namespace lstm_planner
