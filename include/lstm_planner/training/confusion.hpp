#pragma once

#include <string>
#include <vector>

#include "lstm_planner/training/gradient.hpp"

namespace lstm_planner {

/// Share of a label's steps that were answered with it, one a label; NaN for a label that does not occur.
std::vector<double> recalls(const ConfusionMatrix& confusion);

/// Share of an answer's steps that had it as their label, one an answer; NaN for an answer that was not given.
std::vector<double> precisions(const ConfusionMatrix& confusion);

/// Mean of the recalls of the labels that occur, in [0, 1]: always giving the same answer scores 1 / labels. 0 without
/// steps.
double balancedAccuracy(const ConfusionMatrix& confusion);

/// Share of the steps that were answered with their label. 0 without steps.
double accuracyOf(const ConfusionMatrix& confusion);

/// Majority-class baseline: what always giving the most frequent label would have made of the same steps: what a
/// network has to beat.
ConfusionMatrix constantAnswer(const ConfusionMatrix& confusion);

/// For people: a row a label with its answers and recall, and a last row with the precisions. `names` has one text a
/// class. Throws std::invalid_argument unless there are as many names as classes.
std::string confusionText(const ConfusionMatrix& confusion, const std::vector<std::string>& names);

/// Draws it with gnuplot as a PNG picture, each row in shares of its label; the counts are written beside it as CSV.
/// Throws std::invalid_argument as confusionText(), std::runtime_error when a file cannot be written or gnuplot is
/// missing or fails; the CSV file is complete by then.
void writeConfusion(const std::string& png_path, const ConfusionMatrix& confusion,
                    const std::vector<std::string>& names);

}  // namespace lstm_planner
