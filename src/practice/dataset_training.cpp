#include "lstm_planner/practice/dataset_training.hpp"

#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>

#include "lstm_planner/common/parameter_check.hpp"
#include "practice/drive_augmentation.hpp"

namespace lstm_planner {
namespace {

void requireSteps(const std::vector<Sequence>& sequences, const char* name) {
  if (!sequences.empty()) return;
  throw std::invalid_argument(std::string("the ") + name +
                              " set has no steps, expected at least one episode with some");
}

/// What tells a drive from all others.
auto beginningOf(const RecordedEpisode& episode) {
  const DriveStep& first = episode.steps.front();
  return std::make_tuple(first.stamp, first.pose.x, first.pose.y, first.pose.yaw, first.observation.sector_ranges);
}

template <typename Function>
void forEachDrive(const Dataset& dataset, const Function& function) {
  for (const Recording& recording : dataset.recordings) {
    for (const RecordedEpisode& episode : recording.episodes) {
      if (!episode.steps.empty()) function(episode);
    }
  }
}

void requireDifferentDrives(const DatasetSplit& parts) {
  std::set<decltype(beginningOf(RecordedEpisode()))> learned;
  forEachDrive(parts.training, [&](const RecordedEpisode& episode) { learned.insert(beginningOf(episode)); });
  forEachDrive(parts.validation, [&](const RecordedEpisode& episode) {
    if (learned.count(beginningOf(episode)) == 0) return;
    std::ostringstream message;
    message.precision(12);
    message << "the drive that starts at " << episode.steps.front().stamp
            << " s is in the training set and in the validation set, expected other drives to judge what was learned";
    throw std::invalid_argument(message.str());
  });
}

}  // namespace

DatasetTrainingParameters thesisDatasetTraining() {
  DatasetTrainingParameters parameters;
  parameters.sequences.sequence_steps = 30;
  TrainerParameters& trainer = parameters.trainer;
  trainer.epochs = 500;
  trainer.batch_size = 1;
  trainer.averaging = 0.999;
  OptimiserParameters& optimiser = trainer.optimiser;
  optimiser.kind = OptimiserKind::kMomentum;
  optimiser.learning_rate = 0.1;
  optimiser.schedule = LearningRateSchedule::kConstant;
  optimiser.momentum = 0.95;
  optimiser.l1_decay = 1e-5;
  optimiser.max_gradient_norm = 1.0;
  return parameters;
}

DatasetTrainingParameters stableDatasetTraining() {
  DatasetTrainingParameters parameters;
  parameters.sequences.sequence_steps = 60;
  parameters.sequences.burn_in_steps = 30;
  parameters.sequences.label_distance = 0.6;
  parameters.variants = 7;
  TrainerParameters& trainer = parameters.trainer;
  trainer.epochs = 60;
  trainer.batch_size = 16;
  trainer.averaging = 0.98;
  trainer.optimiser.kind = OptimiserKind::kAdam;
  trainer.optimiser.learning_rate = 0.01;
  trainer.optimiser.schedule = LearningRateSchedule::kCosine;
  return parameters;
}

DatasetTrainingParameters fineTuning() {
  DatasetTrainingParameters parameters = stableDatasetTraining();
  parameters.trainer.epochs = 30;
  parameters.trainer.optimiser.learning_rate = 0.002;
  return parameters;
}

void validate(const DatasetTrainingParameters& parameters) {
  validate(parameters.sequences);
  checkParameter(parameters.variants >= 0, "variants", parameters.variants, "zero or more");
  validate(parameters.trainer);
}

DatasetTrainingSets makeTrainingSets(const DatasetSplit& parts, const DatasetTrainingParameters& parameters) {
  validate(parameters);
  requireDifferentDrives(parts);
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
  if (parameters.variants > 0) {
    const Dataset variants = variantsOf(parts.training, parameters.variants, parameters.trainer.seed);
    std::vector<Sequence> more = datasetSequences(variants, parameters.sequences);
    std::move(more.begin(), more.end(), std::back_inserter(sets.training));
  }
  sets.label_weights = labelWeights(countLabels(sets.training, classes), parameters.balance);
  weigh(sets.label_weights, &sets.training);
  return sets;
}

}  // namespace lstm_planner
