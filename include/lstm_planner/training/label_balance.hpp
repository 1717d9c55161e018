#pragma once

#include <vector>

#include "lstm_planner/training/sequence.hpp"

namespace lstm_planner {

/// How much more the steps with a rare label count in training: drivers nearly always go straight on.
enum class LabelBalance {
  kNone,        ///< every step counts the same
  kSquareRoot,  ///< the weight is the inverse square root of how often the label occurs
  kInverse      ///< the weight is the inverse of how often it occurs: every label counts the same
};

/// How often each of `classes` labels occurs in the steps whose weight is not 0.
std::vector<long> countLabels(const std::vector<Sequence>& sequences, int classes);

/// One weight for each label, with a mean of 1 over all counted steps; 0 for a label that does not occur.
std::vector<double> labelWeights(const std::vector<long>& counts, LabelBalance balance);

/// Multiplies each step's weight by that of its label.
void weigh(const std::vector<double>& label_weights, std::vector<Sequence>* sequences);

/// Accuracy of the majority-class baseline (always the most frequent label), in [0, 1]; 0 without steps.
double constantAnswerAccuracy(const std::vector<long>& counts);

}  // namespace lstm_planner
