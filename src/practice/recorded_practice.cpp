#include "practice/recorded_practice.hpp"

#include <cstddef>
#include <utility>

#include "lstm_planner/practice/recorded_choices.hpp"
#include "lstm_planner/training/label_balance.hpp"

namespace lstm_planner {
namespace {

PracticeEpisode toPractice(const std::vector<RecordedChoice>& choices, const Encoder& encoder, std::size_t actions) {
  const auto own = static_cast<std::size_t>(encoder.size());
  PracticeEpisode episode;
  episode.recorded = true;
  episode.probabilities.assign(choices.size() * actions, 1.0f / static_cast<float>(actions));
  episode.inputs.assign(choices.size() * (own + kDrivePrivilegedInputs), 0.0f);
  float* input = episode.inputs.data();
  for (const RecordedChoice& choice : choices) {
    encoder.encode(choice.observation, Eigen::Map<Eigen::VectorXf>(input, encoder.size()));
    input += own + kDrivePrivilegedInputs;
    if (encoder.parameters().views != 1) episode.bearings.push_back(bearingsOf(choice.observation));
    PracticeEpisode::Step step;
    step.action = choice.label;
    step.chosen = true;
    episode.steps.push_back(step);
  }
  return episode;
}

void weigh(std::size_t actions, std::vector<PracticeEpisode>* episodes) {
  std::vector<long> counts(actions);
  for (const PracticeEpisode& episode : *episodes) {
    for (const PracticeEpisode::Step& step : episode.steps) ++counts[static_cast<std::size_t>(step.action)];
  }
  const std::vector<double> weights = labelWeights(counts, LabelBalance::kSquareRoot);
  for (PracticeEpisode& episode : *episodes) {
    for (PracticeEpisode::Step& step : episode.steps) {
      step.weight = static_cast<float>(weights[static_cast<std::size_t>(step.action)]);
    }
  }
}

}  // namespace

std::vector<PracticeEpisode> recordedPractice(const Dataset& dataset, const PolicyDescription& policy,
                                              double label_distance) {
  const Encoder encoder(policy.encoder);
  const auto actions = static_cast<std::size_t>(policy.actions.size());
  std::vector<PracticeEpisode> episodes;
  forEachRecordedEpisode(dataset, policy, label_distance, [&](const std::vector<RecordedChoice>& choices) {
    episodes.push_back(toPractice(choices, encoder, actions));
  });
  weigh(actions, &episodes);
  return episodes;
}

}  // namespace lstm_planner
