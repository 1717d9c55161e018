#include "lstm_planner/learning/dataset_training.hpp"

#include <stdexcept>
#include <string>

namespace lstm_planner {
namespace {

void requireSteps(const std::vector<Sequence>& sequences, const char* name) {
  if (!sequences.empty()) return;
  throw std::invalid_argument(std::string("the ") + name + " set has no steps, expected at least one episode with some");
}

}  // namespace

DatasetTrainingParameters thesisDatasetTraining() {
  DatasetTrainingParameters parameters;
  parameters.sequences.sequence_steps = 30;
  TrainerParameters& trainer = parameters.trainer;
  trainer.epochs = 500;
  trainer.batch_size = 1;
  trainer.shards = 1;
  trainer.averaging = 0.999;
  OptimiserParameters& optimiser = trainer.optimiser;
  optimiser.kind = OptimiserKind::kMomentum;
  optimiser.learning_rate = 0.1;
  optimiser.schedule = LearningRateSchedule::kConstant;
  optimiser.momentum = 0.95;
  optimiser.decay = Decay::kL1;
  optimiser.decay_rate = 1e-5;
  optimiser.max_gradient_norm = 1.0;
  return parameters;
}

DatasetTrainingParameters stableDatasetTraining() {
  DatasetTrainingParameters parameters;
  parameters.sequences.sequence_steps = 60;
  parameters.sequences.burn_in_steps = 30;
  TrainerParameters& trainer = parameters.trainer;
  trainer.epochs = 200;
  trainer.batch_size = 16;
  trainer.shards = 2;
  trainer.averaging = 0.98;
  trainer.optimiser.kind = OptimiserKind::kAdam;
  trainer.optimiser.learning_rate = 0.01;
  trainer.optimiser.schedule = LearningRateSchedule::kCosine;
  return parameters;
}

DatasetTrainingParameters fineTuning() {
  DatasetTrainingParameters parameters = stableDatasetTraining();
  parameters.trainer.epochs = 50;
  parameters.trainer.optimiser.learning_rate = 0.002;
  return parameters;
}

DatasetTrainingSets makeTrainingSets(const DatasetParts& parts, const DatasetTrainingParameters& parameters) {
  DatasetTrainingSets sets;
  const int classes = parameters.sequences.policy.actions.size();
  sets.training = datasetSequences(parts.training, parameters.sequences);
  DatasetSequenceParameters whole = parameters.sequences;
  whole.sequence_steps = 0;
  sets.validation = datasetSequences(parts.validation, whole);
  requireSteps(sets.training, "training");
  requireSteps(sets.validation, "validation");
  sets.training_labels = countLabels(sets.training, classes);
  sets.validation_labels = countLabels(sets.validation, classes);
  sets.label_weights = labelWeights(sets.training_labels, parameters.balance);
  weigh(sets.label_weights, &sets.training);
  return sets;
}

}  // namespace lstm_planner
