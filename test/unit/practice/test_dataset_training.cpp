#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "lstm_planner/practice/dataset_training.hpp"
#include "lstm_planner/training/confusion.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "unit/simulation/recorded_drives_fixtures.hpp"

namespace lstm_planner::test_dataset_training {
namespace {

LayerStack newNetwork(const DatasetTrainingParameters& parameters) {
  const PolicyDescription& policy = parameters.sequences.policy;
  return initialised(makeLstmStack(static_cast<int>(policy.encoder.input_layout.size()), {8, 8}, policy.actions.size()),
                     1);
}

TEST(DatasetTraining, ThesisPresetIsItsTable) {
  const DatasetTrainingParameters parameters = thesisDatasetTraining();
  EXPECT_EQ(parameters.sequences.sequence_steps, 30);
  EXPECT_EQ(parameters.sequences.label_distance, 0.0);
  EXPECT_EQ(parameters.balance, LabelBalance::kNone);
  EXPECT_EQ(parameters.variants, 0);
  EXPECT_EQ(parameters.trainer.epochs, 500);
  EXPECT_EQ(parameters.trainer.batch_size, 1);
  const OptimiserParameters& optimiser = parameters.trainer.optimiser;
  EXPECT_EQ(optimiser.kind, OptimiserKind::kMomentum);
  EXPECT_EQ(optimiser.learning_rate, 0.1);
  EXPECT_EQ(optimiser.schedule, LearningRateSchedule::kConstant);
  EXPECT_EQ(optimiser.momentum, 0.95);
  EXPECT_EQ(optimiser.l1_decay, 1e-5);
}

TEST(DatasetTraining, SetsCountWhatWasRecordedAndWeighWhatIsLearned) {
  const Dataset dataset = drivesAllAround(20, 40, 1);
  DatasetTrainingParameters parameters = stableDatasetTraining();
  parameters.sequences.policy = policyOf(dataset);
  parameters.sequences.label_distance = 0.0;
  parameters.sequences.sequence_steps = 15;
  parameters.sequences.burn_in_steps = 5;
  parameters.variants = 1;
  parameters.balance = LabelBalance::kInverse;
  const DatasetTrainingSets sets = makeTrainingSets(splitDataset(dataset, 0.25, 1), parameters);
  long training = 0;
  for (const long count : sets.training_labels) training += count;
  EXPECT_EQ(training, 15 * 40);
  EXPECT_EQ(sets.training.size(), 2u * 15u * 3u);  // 15 + 15 + 10 steps of each drive and its variant
  EXPECT_EQ(sets.validation.size(), 5u);           // whole drives
  double weight = 0.0;
  for (const Sequence& sequence : sets.training) weight += sequence.weights.sum();
  EXPECT_NEAR(weight, 2.0 * 15 * 40, 1e-2);  // 1 on average
  for (const Sequence& sequence : sets.validation) EXPECT_EQ(sequence.weights.sum(), 40.0f);
}

TEST(DatasetTraining, BothPresetsLearnToDriveTowardsTheGoal) {
  const Dataset dataset = drivesAllAround(60, 25, 1);
  const DatasetSplit parts = splitDataset(dataset, 0.25, 1);
  for (DatasetTrainingParameters parameters : {thesisDatasetTraining(), stableDatasetTraining()}) {
    parameters.sequences.policy = policyOf(dataset);
    parameters.sequences.label_distance = 0.0;
    parameters.trainer.epochs = std::min(parameters.trainer.epochs, 60);
    parameters.trainer.threads = 1;
    const DatasetTrainingSets sets = makeTrainingSets(parts, parameters);
    const TrainingResult result = train(newNetwork(parameters), sets.training, sets.validation, parameters.trainer);
    const LossSum sum = evaluate(result.layers, sets.validation);
    // The rule is the nearest angle to the goal's bearing, which is an input: only bearings near the middle between two
    // angles are hard.
    EXPECT_GT(sum.accuracy(), constantAnswerAccuracy(sets.validation_labels));
    EXPECT_GT(sum.accuracy(), 0.95);
  }
}

TEST(DatasetTraining, ADriveCannotJudgeWhatWasLearnedFromIt) {
  const Dataset dataset = drivesAllAround(4, 5, 1);
  DatasetTrainingParameters parameters = stableDatasetTraining();
  parameters.sequences.policy = policyOf(dataset);
  Dataset validation = drivesAllAround(3, 5, 2);
  EXPECT_NO_THROW(makeTrainingSets({dataset, validation}, parameters));
  validation.recordings[0].episodes.push_back(dataset.recordings[0].episodes[2]);
  EXPECT_THROW(makeTrainingSets({dataset, validation}, parameters), std::invalid_argument);
}

TEST(DatasetTraining, EmptySetsAndBadParametersAreRefused) {
  const Dataset dataset = drivesAllAround(4, 5, 1);
  DatasetTrainingParameters parameters = stableDatasetTraining();
  parameters.sequences.policy = policyOf(dataset);
  EXPECT_THROW(makeTrainingSets({dataset, {}}, parameters), std::invalid_argument);
  EXPECT_THROW(makeTrainingSets({{}, dataset}, parameters), std::invalid_argument);
  parameters.variants = -1;
  EXPECT_THROW(makeTrainingSets({dataset, dataset}, parameters), std::invalid_argument);
  parameters.variants = 0;
  parameters.sequences.policy.encoder.views = 8;
  EXPECT_THROW(validate(parameters), std::invalid_argument) << "recordings teach one view only";
}

}  // namespace
}  // namespace lstm_planner::test_dataset_training
