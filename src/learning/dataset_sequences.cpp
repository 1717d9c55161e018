#include "lstm_planner/learning/dataset_sequences.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/agent/drive_trace.hpp"
#include "lstm_planner/parameter_check.hpp"

namespace lstm_planner {
namespace {

constexpr double kSameRange = 1e-6;  ///< m
constexpr double kSameAngle = 1e-4;  ///< rad; angles in files have few digits

bool isUsed(const RecordedEpisode& recorded) { return !recorded.episode.discarded && !recorded.steps.empty(); }

bool isSameRange(double a, double b) { return std::abs(a - b) < kSameRange; }

bool isSame(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return std::abs(x - y) < kSameAngle; });
}

std::string nameOf(const Recording& recording) { return "the recording from '" + recording.description.source + "'"; }

/// Encodes and labels the steps of one recording.
class RecordingReader {
 public:
  RecordingReader(const Recording& recording, const DatasetSequenceParameters& parameters, const Encoder& encoder)
      : recording_(recording),
        parameters_(parameters),
        encoder_(encoder),
        recorded_labels_(isSame(recorded().action_angles, actions().angles())),
        recorded_sectors_(isSameRange(recorded().range_cap, encoder.parameters().range_cap)) {}

  std::vector<int> labels(const RecordedEpisode& episode) const {
    std::vector<int> labels;
    for (std::size_t step = 0; step < episode.steps.size(); ++step) labels.push_back(label(episode.steps, step));
    return labels;
  }

  /// `trace`: of the episode's steps before.
  void encode(const DriveStep& step, double previous_action, DriveTrace* trace,
              Eigen::Ref<Eigen::VectorXf> input) const {
    Observation observation = observe(sectors(step), step.pose, step.goal, previous_action,
                                      encoder_.parameters().position_cell);
    trace->look(step.pose, &observation);
    observation.visits = step.observation.visits;
    encoder_.encode(observation, input);
  }

 private:
  const RecorderParameters& recorded() const { return recording_.description.parameters; }
  const ActionSet& actions() const { return parameters_.policy.actions; }

  int label(const std::vector<DriveStep>& steps, std::size_t index) const {
    const DriveStep& step = steps[index];
    if (parameters_.label_distance > 0.0) {
      const Pose2& ahead = poseAhead(steps, index);
      if (distanceBetween(step.pose, ahead) >= recorded().min_step_distance) {
        return actions().nearest(normalizeAngle(directionTo(step.pose, ahead) - step.pose.yaw));
      }
    }
    return recorded_labels_ ? step.label : actions().nearest(step.driven_angle);
  }

  const Pose2& poseAhead(const std::vector<DriveStep>& steps, std::size_t index) const {
    const auto far = [&](const DriveStep& later) {
      return distanceBetween(steps[index].pose, later.next_pose) >= parameters_.label_distance;
    };
    const auto first = std::find_if(steps.begin() + static_cast<std::ptrdiff_t>(index), steps.end(), far);
    return first == steps.end() ? steps.back().next_pose : first->next_pose;
  }

  Sectors sectors(const DriveStep& step) const {
    if (recorded_sectors_) {
      Sectors sectors;
      sectors.range = step.observation.sector_ranges;
      return sectors;
    }
    if (step.ranges.empty()) {
      throw std::invalid_argument(nameOf(recording_) + " has a range cap of " + std::to_string(recorded().range_cap) +
                                  " m, the network one of " + std::to_string(encoder_.parameters().range_cap) +
                                  " m, and without kept scans the ranges cannot be averaged anew");
    }
    LaserScan scan;
    scan.stamp = step.stamp;
    scan.angle_min = step.geometry.angle_min;
    scan.angle_increment = step.geometry.angle_increment;
    scan.range_min = step.geometry.range_min;
    scan.range_max = step.geometry.range_max;
    scan.ranges = step.ranges;
    return averageSectors(scan, step.geometry.mount, {}, encoder_.parameters().range_cap);
  }

  const Recording& recording_;
  const DatasetSequenceParameters& parameters_;
  const Encoder& encoder_;
  bool recorded_labels_;   ///< or labels of other allowed angles
  bool recorded_sectors_;  ///< or sectors averaged with another cap
};

/// The whole of an episode.
Sequence toSequence(const RecordedEpisode& episode, const RecordingReader& reader, const Encoder& encoder,
                    const ActionSet& actions) {
  const auto steps = static_cast<Eigen::Index>(episode.steps.size());
  const std::vector<int> labels = reader.labels(episode);
  Sequence sequence{Eigen::MatrixXf(encoder.size(), steps), Eigen::VectorXi(steps), Eigen::VectorXf::Ones(steps)};
  DriveTrace trace;
  for (Eigen::Index step = 0; step < steps; ++step) {
    const auto i = static_cast<std::size_t>(step);
    reader.encode(episode.steps[i], i == 0 ? 0.0 : actions.angle(labels[i - 1]), &trace, sequence.inputs.col(step));
    sequence.labels[step] = labels[i];
  }
  return sequence;
}

void cut(const Sequence& episode, int piece, int burn_in, std::vector<Sequence>* pieces) {
  const Eigen::Index length = piece > 0 ? piece : episode.steps();
  for (Eigen::Index first = 0; first < episode.steps(); first += length) {
    const Eigen::Index burnt = std::min<Eigen::Index>(first, burn_in);
    const Eigen::Index steps = burnt + std::min(length, episode.steps() - first);
    Sequence sequence{episode.inputs.middleCols(first - burnt, steps), episode.labels.segment(first - burnt, steps),
                      episode.weights.segment(first - burnt, steps)};
    sequence.weights.head(burnt).setZero();
    pieces->push_back(std::move(sequence));
  }
}

}  // namespace

void validate(const DatasetSequenceParameters& parameters) {
  checkParameter(parameters.sequence_steps >= 0, "sequence_steps", parameters.sequence_steps, "zero or more");
  checkParameter(parameters.burn_in_steps >= 0, "burn_in_steps", parameters.burn_in_steps, "zero or more");
  checkParameter(parameters.label_distance >= 0.0, "label_distance", parameters.label_distance, "zero or more");
  validate(parameters.policy.encoder);
  checkParameter(parameters.policy.encoder.views == 1, "views", parameters.policy.encoder.views,
                 "1: eight views learn by reinforcement only");
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
  for (const Recording& recording : dataset.recordings) {
    const RecordingReader reader(recording, parameters, encoder);
    for (const RecordedEpisode& episode : recording.episodes) {
      if (!isUsed(episode)) continue;
      cut(toSequence(episode, reader, encoder, parameters.policy.actions), parameters.sequence_steps,
          parameters.burn_in_steps, &sequences);
    }
  }
  return sequences;
}

}  // namespace lstm_planner
