#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/dataset/recorder_parameters.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "tools/command_line.hpp"

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

/// How driving is cut into steps. `parameters` must stay where they are until the line is parsed.
void addRecorderOptions(RecorderParameters* parameters, CommandLine* line);

/// --mount "x y yaw" (m, m, rad): where the scanner sits, if not where `otherwise` says; likewise.
void addMountOption(std::optional<SensorMount>* mount, const std::string& otherwise, CommandLine* line);

}  // namespace lstm_planner
