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
  int variants = 0;  ///< number of mirrored and turned copies of each training episode that are used in addition
  TrainerParameters trainer;
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const DatasetTrainingParameters& parameters);

/// The training of the thesis: Table 4.2, sequences of 30 steps, an update after each. The thesis names no limit of the
/// gradient's length; here it is 1. Averaged weights are kept, over about ten epochs of 3,000 steps; they have no
/// effect on the training itself.
DatasetTrainingParameters thesisDatasetTraining();

/// The same without jumps of the accuracy: many sequences per update, a learning rate that falls to 0, hidden states
/// that are right at each sequence's first counted step, averaged weights. Labels point to a place a little beyond the
/// planner's waypoint: the path of half a second shows more of the driver's steering errors than of where he wants to
/// go. Each drive has seven variants.
DatasetTrainingParameters stableDatasetTraining();

/// As stableDatasetTraining(), for a network that can drive already and shall learn from somebody's own drives:
/// shorter, and with a smaller learning rate.
DatasetTrainingParameters fineTuning();

/// What is learned from, and what the network is judged on.
struct DatasetTrainingSets {
  std::vector<Sequence> training;     ///< cut into pieces and weighted as the parameters say
  std::vector<Sequence> validation;   ///< whole episodes, as the planner drives them, each step with weight 1
  std::vector<long> training_labels;  ///< as recorded, without variants
  std::vector<long> validation_labels;
  std::vector<double> label_weights;  ///< of the training set
};

/// Throws std::invalid_argument as validate() and datasetSequences(), if a set has no steps, and if a drive is in both.
DatasetTrainingSets makeTrainingSets(const DatasetSplit& parts, const DatasetTrainingParameters& parameters);

}  // namespace lstm_planner
