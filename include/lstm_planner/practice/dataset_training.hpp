#pragma once

#include <vector>

#include "lstm_planner/dataset/dataset_edit.hpp"
#include "lstm_planner/practice/dataset_sequences.hpp"
#include "lstm_planner/training/label_balance.hpp"
#include "lstm_planner/training/sequence.hpp"
#include "lstm_planner/training/trainer.hpp"

namespace lstm_planner {

/// How a network learns from recorded drives.
struct DatasetTrainingParameters {
  DatasetSequenceParameters sequences;
  LabelBalance balance = LabelBalance::kNone;
  int variants = 0;  ///< of each training episode that are learned from besides itself: see variantsOf()
  TrainerParameters trainer;
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const DatasetTrainingParameters& parameters);

/// The training of the thesis: table 4.2, sequences of 30 steps, an update after each. The thesis names no limit of the
/// gradient's length; 1 is taken here. What is kept are averaged weights, over some ten epochs of 3,000 steps; they
/// take no part in the training itself.
DatasetTrainingParameters thesisDatasetTraining();

/// The same in a way that does not jump: many sequences an update, a learning rate that sinks to 0, hidden states that
/// are right at each sequence's first counted step, averaged weights. Labels lead a little farther than the planner's
/// waypoints lie: the path of half a second is more of the driver's hand than of where he wants to go. Each drive has
/// seven variants.
DatasetTrainingParameters stableDatasetTraining();

/// As stableDatasetTraining(), for a network that drives already and is to get used to somebody's own drives: shorter,
/// and with smaller steps.
DatasetTrainingParameters fineTuning();

/// What is learned from and what it is judged by.
struct DatasetTrainingSets {
  std::vector<Sequence> training;     ///< cut into pieces and weighed as the parameters say
  std::vector<Sequence> validation;   ///< whole episodes, as the planner drives them, each step with weight 1
  std::vector<long> training_labels;  ///< as recorded, without variants
  std::vector<long> validation_labels;
  std::vector<double> label_weights;  ///< of the training set
};

/// Throws std::invalid_argument as validate() and datasetSequences(), when a set has no steps, and when a drive is
/// in both.
DatasetTrainingSets makeTrainingSets(const DatasetSplit& parts, const DatasetTrainingParameters& parameters);

}  // namespace lstm_planner
