#pragma once

#include <optional>
#include <string>

#include "lstm_planner/dataset/hindsight.hpp"
#include "lstm_planner/dataset/recorder_parameters.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "tools/command_line.hpp"

namespace lstm_planner {

/// How driving is cut into steps. `parameters` must stay where they are until the line is parsed.
void addRecorderOptions(RecorderParameters* parameters, CommandLine* line);

/// Goals that are found in hindsight; likewise.
void addHindsightOptions(HindsightParameters* parameters, CommandLine* line);

/// --mount "x y yaw" (m, m, rad): where the scanner sits, if not where `otherwise` says; likewise.
void addMountOption(std::optional<SensorMount>* mount, const std::string& otherwise, CommandLine* line);

}  // namespace lstm_planner
