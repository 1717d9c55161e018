#include "lstm_planner/training/imitation_rounds.hpp"

#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/training/parameter_vector.hpp"

namespace lstm_planner {
namespace {

void append(std::vector<Sequence> more, std::vector<Sequence>* sequences) {
  std::move(more.begin(), more.end(), std::back_inserter(*sequences));
}

void append(const std::vector<EpochReport>& round, std::vector<EpochReport>* curve) {
  for (EpochReport report : round) {
    report.epoch = static_cast<int>(curve->size()) + 1;
    curve->push_back(std::move(report));
  }
}

}  // namespace

ImitationRounds::ImitationRounds(const ImitationRoundsParameters& parameters, const LayerStack& layers,
                                 std::unique_ptr<ImitationCourse> course)
    : parameters_(parameters), first_layers_(layers), layers_(layers), course_(std::move(course)) {
  checkPositive("rounds", parameters.rounds);
  checkParameter(parameters.batch_steps >= 0, "batch_steps", parameters.batch_steps, "zero or more");
}

std::vector<EpochReport> ImitationRounds::curve() const {
  std::vector<EpochReport> all = state_.curve;
  append(state_.training.curve, &all);
  return all;
}

double ImitationRounds::progress() const {
  const double epochs = parameters_.trainer.epochs;
  return (round() - 1 + epochsOfRound() / epochs) / parameters_.rounds;
}

void ImitationRounds::step() {
  if (!trainer_) {
    collect(0);
    startRound();
  } else if (roundDone()) {
    endRound();
    collect(round() - 1);
    startRound();
  }
  if (trainer_->runEpoch().best) setParameterVector(state_.training.best_weights, layers_);
}

void ImitationRounds::restore(const std::vector<std::uint8_t>& checkpoint) {
  state_ = imitationStateFrom(checkpoint);
  if (round() > parameters_.rounds) {
    throw std::invalid_argument("the imitation's state is of round " + std::to_string(round()) + ", expected " +
                                std::to_string(parameters_.rounds) + " at most");
  }
  training_.clear();
  validation_.clear();
  layers_ = first_layers_;
  collect(0);
  for (std::size_t round = 0; round < state_.learners.size(); ++round) {
    setParameterVector(state_.learners[round], layers_);
    collect(static_cast<int>(round) + 1);
  }
  startRound();
  if (!state_.training.curve.empty()) setParameterVector(state_.training.best_weights, layers_);
}

/// With the learner of the round before.
void ImitationRounds::collect(int round) {
  const LayerStack* learner = round > 0 ? &layers_ : nullptr;
  append(course_->collectValidation(round, learner), &validation_);
  append(course_->collectTraining(round, learner), &training_);
}

void ImitationRounds::startRound() {
  TrainerParameters trainer = parameters_.trainer;
  if (parameters_.batch_steps > 0) trainer.batch_size = sequencesWithSteps(parameters_.batch_steps, training_);
  trainer_ = std::make_unique<Trainer>(layers_, training_, validation_, trainer, &state_.training);
}

void ImitationRounds::endRound() {
  trainer_.reset();
  append(state_.training.curve, &state_.curve);
  state_.learners.push_back(parameterVector(layers_));
  state_.training = {};
}

}  // namespace lstm_planner
