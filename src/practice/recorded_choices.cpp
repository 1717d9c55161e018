#include "lstm_planner/practice/recorded_choices.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/drive/decision/drive_trace.hpp"
#include "practice/recording_comparison.hpp"

namespace lstm_planner {
namespace {

/// Observes and labels the steps of one recording.
class RecordingReader {
 public:
  RecordingReader(const Recording& recording, const PolicyDescription& policy, double label_distance)
      : recording_(recording),
        policy_(policy),
        label_distance_(label_distance),
        recorded_labels_(isSame(recorded().action_angles, actions().angles())),
        recorded_sectors_(isSameRange(recorded().range_cap, policy.encoder.range_cap)) {}

  std::vector<RecordedChoice> choices(const RecordedEpisode& episode) const {
    std::vector<RecordedChoice> choices;
    choices.reserve(episode.steps.size());
    DriveTrace trace;
    for (std::size_t i = 0; i < episode.steps.size(); ++i) {
      const DriveStep& step = episode.steps[i];
      const double previous_action = i == 0 ? 0.0 : actions().angle(choices.back().label);
      RecordedChoice choice;
      choice.observation = observe(sectors(step), step.pose, step.goal, previous_action, policy_.encoder.position_cell);
      trace.update(step.pose, &choice.observation);
      choice.observation.visits = step.observation.visits;
      choice.label = label(episode.steps, i);
      choices.push_back(choice);
    }
    return choices;
  }

 private:
  const RecorderParameters& recorded() const { return recording_.description.parameters; }
  const ActionSet& actions() const { return policy_.actions; }

  int label(const std::vector<DriveStep>& steps, std::size_t index) const {
    const DriveStep& step = steps[index];
    if (label_distance_ > 0.0) {
      const Pose2& ahead = poseAhead(steps, index);
      if (distanceBetween(step.pose, ahead) >= recorded().min_step_distance) {
        return actions().nearest(normalizeAngle(directionTo(step.pose, ahead) - step.pose.yaw));
      }
    }
    return recorded_labels_ ? step.label : actions().nearest(step.driven_angle);
  }

  const Pose2& poseAhead(const std::vector<DriveStep>& steps, std::size_t index) const {
    const auto far = [&](const DriveStep& later) {
      return distanceBetween(steps[index].pose, later.next_pose) >= label_distance_;
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
      throw std::invalid_argument(nameOf(recording_) + " has a range cap of " + numberText(recorded().range_cap) +
                                  " m, the network one of " + numberText(policy_.encoder.range_cap) +
                                  " m, and without kept scans the ranges cannot be averaged anew");
    }
    const LaserScan scan = scanOf(step.geometry, step.ranges);
    return averageSectors(scan, step.geometry.mount, recorded().scan_rules, policy_.encoder.range_cap);
  }

  const Recording& recording_;
  const PolicyDescription& policy_;
  const double label_distance_;
  bool recorded_labels_;   ///< or labels of other allowed angles
  bool recorded_sectors_;  ///< or sectors averaged with another cap
};

}  // namespace

Sequence toSequence(const std::vector<RecordedChoice>& episode, const Encoder& encoder) {
  const auto steps = static_cast<Eigen::Index>(episode.size());
  Sequence sequence{Eigen::MatrixXf(encoder.size(), steps), Eigen::VectorXi::Zero(steps), Eigen::VectorXf::Zero(steps)};
  for (Eigen::Index step = 0; step < steps; ++step) {
    const RecordedChoice& choice = episode[static_cast<std::size_t>(step)];
    encoder.encode(choice.observation, sequence.inputs.col(step));
    if (choice.label < 0) continue;
    sequence.labels[step] = choice.label;
    sequence.weights[step] = 1.0f;
  }
  return sequence;
}

void forEachRecordedEpisode(const Dataset& dataset, const PolicyDescription& policy, double label_distance,
                            const std::function<void(const std::vector<RecordedChoice>&)>& work) {
  for (const Recording& recording : dataset.recordings) {
    const RecordingReader reader(recording, policy, label_distance);
    for (const RecordedEpisode& recorded : recording.episodes) {
      if (!recorded.episode.discarded && !recorded.steps.empty()) work(reader.choices(recorded));
    }
  }
}

ConfusionMatrix preferencesIn(const Dataset& dataset, DrivePolicy policy) {
  const int actions = policy.description().actions.size();
  ConfusionMatrix taken = ConfusionMatrix::Zero(actions, actions);
  const PolicyDescription description = policy.description();
  forEachRecordedEpisode(dataset, description, 0.0, [&](const std::vector<RecordedChoice>& episode) {
    policy.reset();
    for (const RecordedChoice& choice : episode) {
      Eigen::Index preferred = 0;
      policy.advance(choice.observation).maxCoeff(&preferred);
      ++taken(choice.label, preferred);
    }
  });
  return taken;
}

}  // namespace lstm_planner
