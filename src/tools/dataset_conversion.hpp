#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// Files that are one recording.
using Parts = std::vector<std::string>;

/// Records what the files hold, and prints what it found; it may complete the description.
using Converter = std::function<void(const Parts& parts, RecordingSink* sink)>;

/// Makes a new dataset, one recording of each source, and says what became of each. Returns the exit status: 1, and
/// nothing is written, if there is no step. What `convert` throws ends the work and is thrown again when the recordings
/// before it are written.
int convertIntoDataset(const std::vector<Parts>& sources, const RecorderParameters& parameters,
                       const std::string& output, const Converter& convert);

}  // namespace lstm_planner
