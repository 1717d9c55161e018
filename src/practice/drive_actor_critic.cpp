#include "lstm_planner/practice/drive_actor_critic.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/practice/recorded_choices.hpp"
#include "lstm_planner/training/actor_critic.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/label_balance.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "practice/drive_batch.hpp"
#include "practice/drive_practice.hpp"

namespace lstm_planner {
namespace {

const std::vector<int> kCriticUnits = {48, 32};  ///< of each layer
constexpr int kPasses = 4;                       ///< over what was collected

PracticeEpisode toPractice(const std::vector<RecordedChoice>& choices, const Encoder& encoder, std::size_t actions) {
  PracticeEpisode episode;
  episode.is_example = true;
  episode.probabilities.assign(choices.size() * actions, 1.0f / static_cast<float>(actions));
  for (const RecordedChoice& choice : choices) {
    addStep(encoder, choice.observation, &episode);
    episode.steps.back().action = choice.label;
    episode.steps.back().chosen = true;
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

/// Recorded drives in the form of practised ones, with the driver's steering angles as actions. Rare angles weigh more
/// (LabelBalance::kSquareRoot), 1 on average. Throws as forEachRecordedEpisode().
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

/// Preferences so many times as far apart: the greedy choice stays, random ones come nearer to it.
LayerStack sharpened(LayerStack layers, double factor) {
  auto* last = std::get_if<DenseLayer>(&layers.back());
  if (!last) throw std::invalid_argument("the policy's last layer is not fully connected");
  last->weights *= static_cast<float>(factor);
  last->bias *= static_cast<float>(factor);
  return layers;
}

class PractisingActorCritic final : public DriveActorCritic {
 public:
  PractisingActorCritic(const DriveActorCriticParameters& parameters, LayerStack layers)
      : parameters_((validate(parameters), parameters)),
        policy_(sharpened(std::move(layers), parameters.sharpness)),
        critic_(initialised(
            makeDenseStack(Encoder(parameters.policy.encoder).size() + kDrivePrivilegedInputs, kCriticUnits, 1),
            parameters.seed + 1)),
        learner_(parameters, parameters.iterations, policy_, critic_, parameters.course.worlds.size()) {
    DrivePolicy(parameters.policy, policy_);  // throws when they do not fit together
  }

  void follow(const Dataset& recordings, double weight) override {
    checkPositive("recordings_weight", weight);
    recorded_ = recordedPractice(recordings, parameters_.policy, 0.0);
    recorded_steps_ = 0.0;
    for (const PracticeEpisode& episode : recorded_) recorded_steps_ += static_cast<double>(episode.steps.size());
    if (recorded_.empty()) throw std::invalid_argument("the recordings have no steps, expected at least one");
    imitation_ = weight;
  }

  bool done() const override { return learner_.updates() >= parameters_.iterations; }
  bool judgementDue() const override {
    const int interval = std::max(1, parameters_.iterations / parameters_.judgements);
    return done() || learner_.updates() % interval == 0;
  }

  void step() override {
    std::vector<PracticeEpisode> episodes = practise(parameters_, policy_, learner_.updates());
    const PracticeSums sums = sumUp(episodes);
    addRecorded(sums.steps, &episodes);
    DriveBatch batch(parameters_, policy_, critic_, episodes);
    DriveBatchWeights weights;
    weights.entropy = learner_.entropyWeight();
    batch.judge(learner_.critic(), &learner_.advantageVariances());
    weights.advantage_variances = learner_.advantageVariances();
    // The critic is new at first: let it learn before the policy follows it.
    const bool critic_alone = learner_.updates() == 0;
    for (int pass = 0; pass < kPasses; ++pass) {
      batch.rewind();
      while (batch.next()) {
        Eigen::VectorXf gradient;
        if (!critic_alone) {
          const double chosen = batch.policyGradient(learner_.policy(), weights, &gradient);
          if (chosen > 0.0) learner_.updatePolicy(gradient, chosen);
        }
        const double steps = batch.criticGradient(learner_.critic(), &gradient);
        if (steps > 0.0) learner_.updateCritic(gradient, steps);
      }
    }
    setParameterVector(learner_.policy(), policy_);
    learner_.finishUpdate(sums.steps);
    report_ = {learner_.updates(), learner_.steps(), sums.reward,
               sums.arrival,       batch.entropy(),  batch.judged().explained()};
  }

  const ReinforcementReport& report() const override { return report_; }
  int iterations() const override { return learner_.updates(); }
  const LayerStack& layers() const override { return policy_; }

  std::vector<std::uint8_t> checkpoint() const override { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override {
    learner_.restore(checkpoint);
    setParameterVector(learner_.policy(), policy_);
  }

 private:
  /// Weighs the recorded steps as follow() says, beside so many practised ones.
  void addRecorded(double practised_steps, std::vector<PracticeEpisode>* episodes) const {
    for (PracticeEpisode episode : recorded_) {
      for (PracticeEpisode::Step& step : episode.steps) {
        step.weight =
            static_cast<float>(static_cast<double>(step.weight) * imitation_ * practised_steps / recorded_steps_);
      }
      episodes->push_back(std::move(episode));
    }
  }

  DriveActorCriticParameters parameters_;
  LayerStack policy_;
  LayerStack critic_;
  ActorCritic learner_;
  ReinforcementReport report_;
  std::vector<PracticeEpisode> recorded_;
  double recorded_steps_ = 0.0;
  double imitation_ = 0.0;
};

}  // namespace

void validate(const DriveActorCriticParameters& parameters) {
  validate(static_cast<const ActorCriticParameters&>(parameters));
  visitPracticeParameters(parameters, RangeCheck());
  checkAtLeastOne("judgements", parameters.judgements);
  checkParameter(parameters.discount < 1.0, "discount", parameters.discount, "a number in (0, 1)");
  validate(parameters.policy.encoder);
  validate(parameters.course);
}

std::unique_ptr<DriveActorCritic> makeDriveActorCritic(const DriveActorCriticParameters& parameters,
                                                       LayerStack layers) {
  return std::make_unique<PractisingActorCritic>(parameters, std::move(layers));
}

}  // namespace lstm_planner
