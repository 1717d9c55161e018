#pragma once

#include <string>
#include <vector>

#include "lstm_planner/training/gradient.hpp"

namespace lstm_planner {

/// For each label: share of its steps that were answered with it; NaN for a label that does not occur.
std::vector<double> recalls(const ConfusionMatrix& confusion);

/// For each answer: share of its steps that had it as their label; NaN for an answer that was not given.
std::vector<double> precisions(const ConfusionMatrix& confusion);

/// Mean of the recalls of the labels that occur, in [0, 1]: always giving the same answer scores 1 / labels. 0 without
/// steps.
double balancedAccuracy(const ConfusionMatrix& confusion);

/// Share of the steps that were answered with their label. 0 without steps.
double accuracyOf(const ConfusionMatrix& confusion);

/// The confusion matrix of always giving the most frequent label in the same steps: the majority-class baseline.
ConfusionMatrix constantAnswer(const ConfusionMatrix& confusion);

/// For people: a row for each label with its answers and recall, and a last row with the precisions. `names` has one
/// text for each class. Throws std::invalid_argument if the number of names is another.
std::string confusionText(const ConfusionMatrix& confusion, const std::vector<std::string>& names);

/// Draws it with gnuplot as a PNG picture, each row in shares of its label; the counts are written beside it as CSV.
/// Throws std::invalid_argument as confusionText(), and std::runtime_error if a file cannot be written, or if gnuplot
/// is missing or fails; the CSV file is complete by then.
void writeConfusion(const std::string& png_path, const ConfusionMatrix& confusion,
                    const std::vector<std::string>& names);

}  // namespace lstm_planner
