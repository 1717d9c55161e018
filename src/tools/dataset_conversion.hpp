#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lstm_planner/robot/dataset/dataset.hpp"
#include "lstm_planner/robot/dataset/recording_sink.hpp"

namespace lstm_planner {

/// Makes a new dataset, one recording of each file, and says what became of each. `convert` records a file and prints
/// what it found; it may complete the description. Throws what it throws; nothing is written then. Returns the exit
/// status: 1, and nothing is written, if there is no step.
int convertIntoDataset(const std::vector<std::string>& files, const RecorderParameters& parameters,
                       const std::string& output,
                       const std::function<void(const std::string& file, RecordingSink* sink)>& convert);

/// UTC, as RecordingDescription::begun.
std::string utcTime(double seconds_since_1970);

}  // namespace lstm_planner
