#pragma once

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

// What holds for each row that is written to a dataset file or read from it, whoever made the file: readers index
// arrays and reserve memory by these values. Each throws std::invalid_argument saying what is wrong.

void checkRow(const RecordingDescription& description);
void checkRow(const ScanGeometry& geometry);

/// `angles`: the number of allowed angles of its recording.
void checkRow(const DriveStep& step, std::size_t angles);

}  // namespace lstm_planner
