#pragma once

#include <ostream>
#include <string>

#include "lstm_planner/dataset/dataset_summary.hpp"

namespace lstm_planner {

void printDatasetSummary(std::ostream& out, const DatasetSummary& summary);

/// "3 arrived, 1 aborted": how the episodes ended.
std::string endsText(const DatasetSummary& summary);

/// One line for each set of allowed angles: how often each label was driven.
void printLabels(std::ostream& out, const DatasetSummary& summary);

/// Draws the labels, the mean ranges of the sectors, and the driven paths with their goals. Throws std::runtime_error
/// when it cannot be written.
void drawDataset(const std::string& path, const Dataset& dataset);

}  // namespace lstm_planner
