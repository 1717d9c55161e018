#pragma once

#include <boost/program_options.hpp>
#include <optional>
#include <string>

#include "lstm_planner/robot/dataset/hindsight.hpp"
#include "lstm_planner/robot/dataset/recorder_parameters.hpp"
#include "lstm_planner/robot/perception/laser_scan.hpp"

namespace lstm_planner {

/// Options for how driving is cut into steps. The parameters hold the defaults, and are set when the options are parsed
/// and notified.
void addRecorderOptions(RecorderParameters* parameters, boost::program_options::options_description* options);

/// Options for goals that are found in hindsight; likewise.
void addHindsightOptions(HindsightParameters* parameters, boost::program_options::options_description* options);

/// A number with a default that --help shows as a person would write it.
boost::program_options::typed_value<double>* numberOption(double* value);

/// The mount "x y yaw" (m, m, rad); empty of an empty text. Throws std::invalid_argument for anything else.
std::optional<SensorMount> mountOption(const std::string& text);

}  // namespace lstm_planner
