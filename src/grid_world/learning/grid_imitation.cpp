#include "lstm_planner/grid_world/learning/grid_imitation.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/base/learning/parameter_vector.hpp"

namespace lstm_planner {
namespace {

void append(std::vector<Sequence> more, std::vector<Sequence>* sequences) {
  std::move(more.begin(), more.end(), std::back_inserter(*sequences));
}

/// Collects what the rounds learn from and are judged by.
class Collector {
 public:
  Collector(const GridImitationParameters& parameters, const std::vector<GridCourse::Set>& training,
            const std::vector<GridCourse::Set>& validation)
      : parameters_(parameters),
        training_maps_(training),
        validation_course_(parameters.course, validation, seedOf(0, true), parameters.threads) {
    collectValidation(0, nullptr);
  }

  /// For round `round`, from 0; only the first has no learner.
  void collectTraining(int round, const LayerStack* learner) {
    const std::uint64_t seed = seedOf(round, false);
    const GridCourse course(parameters_.course, training_maps_, seed, parameters_.threads);
    append(collect(parameters_.dataset, course, learner, parameters_.learner_share, seed), &training_);
  }

  /// As the learner walks after a round.
  void collectValidation(int round, const LayerStack* learner) {
    GridDatasetParameters dataset = parameters_.dataset;
    dataset.steps = parameters_.validation_steps;
    append(collect(dataset, validation_course_, learner, 1.0, seedOf(round, true)), &validation_);
  }

  const std::vector<Sequence>& training() const { return training_; }
  const std::vector<Sequence>& validation() const { return validation_; }

 private:
  std::uint64_t seedOf(int round, bool validation) const {
    return parameters_.seed * 1000003ULL + static_cast<std::uint64_t>(round) * 2ULL + (validation ? 1ULL : 0ULL);
  }

  std::vector<Sequence> collect(const GridDatasetParameters& dataset, const GridCourse& course,
                                const LayerStack* learner, double learner_share, std::uint64_t seed) const {
    Model model;
    if (learner != nullptr) model.layers = *learner;
    writeMetadata(parameters_.encoder, &model.metadata);
    return collectGridSequences(dataset, parameters_.encoder, course, learner != nullptr ? &model : nullptr,
                                learner_share, seed, parameters_.threads);
  }

  const GridImitationParameters& parameters_;
  const std::vector<GridCourse::Set>& training_maps_;
  GridCourse validation_course_;
  std::vector<Sequence> training_;
  std::vector<Sequence> validation_;
};

/// With as many sequences a batch as have about the wanted number of steps.
TrainerParameters trainerOf(const GridImitationParameters& parameters, const std::vector<Sequence>& training) {
  TrainerParameters trainer = parameters.trainer;
  const double steps_each = static_cast<double>(countLabels(training)) / static_cast<double>(training.size());
  trainer.batch_size = std::max(1, static_cast<int>(std::lround(parameters.batch_steps / steps_each)));
  trainer.seed = parameters.seed;
  trainer.threads = parameters.threads;
  return trainer;
}

void addToCurve(const std::vector<EpochReport>& round, std::vector<EpochReport>* curve) {
  for (EpochReport report : round) {
    report.epoch = static_cast<int>(curve->size()) + 1;
    curve->push_back(std::move(report));
  }
}

}  // namespace

GridImitationParameters thesisImitation() {
  GridImitationParameters parameters;
  parameters.encoder.inputs = GridEncoderParameters::Inputs::kThesis;
  parameters.batch_steps = parameters.dataset.sequence_steps;
  TrainerParameters& trainer = parameters.trainer;
  trainer.epochs = 500;
  trainer.optimiser.kind = OptimiserKind::kMomentum;
  trainer.optimiser.learning_rate = 0.1;
  trainer.optimiser.schedule = LearningRateSchedule::kConstant;
  trainer.optimiser.momentum = 0.95;
  trainer.optimiser.decay = Decay::kL1;
  trainer.optimiser.decay_rate = 1e-5;
  return parameters;
}

void validate(const GridImitationParameters& parameters) {
  if (parameters.encoder.views != 1) {
    throw std::invalid_argument("imitation with " + std::to_string(parameters.encoder.views) +
                                " views is not possible, expected 1 view: networks of 8 views learn by reinforcement");
  }
  validate(parameters.course);
  validate(parameters.dataset);
  validate(parameters.trainer);
  checkParameter(parameters.validation_steps > 0, "validation_steps", parameters.validation_steps, "a positive number");
  checkParameter(parameters.rounds > 0, "rounds", parameters.rounds, "a positive number");
  checkParameter(parameters.learner_share >= 0.0 && parameters.learner_share <= 1.0, "learner_share",
                 parameters.learner_share, "a share in [0, 1]");
  checkParameter(parameters.batch_steps > 0, "batch_steps", parameters.batch_steps, "a positive number");
  checkParameter(parameters.threads > 0, "threads", parameters.threads, "a positive number");
}

GridImitationResult imitateOnGrid(const GridImitationParameters& parameters, const LayerStack& layers,
                                  const std::vector<GridCourse::Set>& training,
                                  const std::vector<GridCourse::Set>& validation,
                                  const GridImitationEpochCallback& epoch_done,
                                  const GridImitationRoundCallback& round_done, const GridImitationState& begun) {
  validate(parameters);
  GridImitationState state = begun;
  GridImitationResult result;
  result.layers = layers;
  Collector collector(parameters, training, validation);
  for (int round = 0; round < parameters.rounds; ++round) {
    const bool learner_walks = round > 0;
    collector.collectTraining(round, learner_walks ? &result.layers : nullptr);
    if (round < static_cast<int>(state.learners.size())) {
      setParameterVector(state.learners[static_cast<std::size_t>(round)], result.layers);
    } else {
      GridImitationRound outcome;
      outcome.round = round + 1;
      outcome.steps = countLabels(collector.training());
      bool go_on = true;
      const auto report = [&](const EpochReport& epoch) {
        go_on = !epoch_done || epoch_done(round + 1, epoch, state);
        return go_on;
      };
      outcome.training = train(result.layers, collector.training(), collector.validation(),
                               trainerOf(parameters, collector.training()), report, &state.training);
      result.layers = outcome.training.layers;
      addToCurve(outcome.training.curve, &state.curve);
      if (round_done) round_done(outcome);
      result.rounds.push_back(std::move(outcome));
      if (!go_on) break;
      state.learners.push_back(parameterVector(result.layers));
      state.training = {};
    }
    if (round + 1 < parameters.rounds) collector.collectValidation(round + 1, &result.layers);
  }
  result.curve = state.curve;
  return result;
}

}  // namespace lstm_planner
