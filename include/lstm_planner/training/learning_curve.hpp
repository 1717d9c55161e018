#pragma once

#include <string>
#include <vector>

#include "lstm_planner/training/trainer.hpp"

namespace lstm_planner {

/// Writes one line for each epoch: epoch, learning_rate, training_accuracy, training_loss, validation_accuracy,
/// validation_loss, best (accuracies in [0, 1]; validation columns empty without a validation set). If weights are
/// averaged, also averaged_accuracy and averaged_loss, on the validation set.
/// Throws std::runtime_error if the file cannot be written.
void writeLearningCurveCsv(const std::string& csv_path, const std::vector<EpochReport>& curve);

/// Writes the CSV file beside the picture, then draws it with gnuplot as a PNG picture: accuracy above, loss below, the
/// best epoch marked. Throws std::runtime_error if the CSV file cannot be written, or if gnuplot is missing or fails;
/// the CSV file is complete by then.
void writeLearningCurve(const std::string& png_path, const std::vector<EpochReport>& curve);

}  // namespace lstm_planner
