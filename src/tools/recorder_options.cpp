#include "tools/recorder_options.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "tools/command_line.hpp"

namespace lstm_planner {
namespace {

SensorMount mountNamed(const std::string& text) {
  std::istringstream stream(text);
  Pose2 pose;
  stream >> pose.x >> pose.y >> pose.yaw;
  if (!stream || !(stream >> std::ws).eof() || !isFinite(pose)) {
    throw std::invalid_argument("option --mount is '" + text + "', expected \"x y yaw\" in m, m and rad");
  }
  return {pose, false};
}

}  // namespace

void addRecorderOptions(RecorderParameters* parameters, CommandLine* line) {
  RecorderParameters& p = *parameters;
  visitRecorderParameters(p, line->parameters({{"period", "period"},
                                               {"min_step_distance", "min-step-distance"},
                                               {"min_step_turn", "min-step-turn"},
                                               {"max_gap", "max-gap"},
                                               {"max_speed", "max-speed"},
                                               {"goal_tolerance", "goal-tolerance"},
                                               {"delay", "delay"},
                                               {"range_cap", "range-cap"},
                                               {"least_measured", "least-measured"}}));
  line->addText(
      "no-return", noReturnText(p.scan_rules), [&](const std::string& text) { setNoReturn(text, &p.scan_rules); },
      "readings that mean no return besides +inf: \"nan\", \"zero\", \"below\" (range_min), \"beyond\" (range_max), a "
      "number (m); for urg_node: \"nan zero beyond 65.53\"");
  line->addFlag("no-scans", &p.keep_scans, false, "store only the sectors, not the whole scans");
}

void addHindsightOptions(HindsightParameters* parameters, CommandLine* line) {
  visitHindsightParameters(*parameters,
                           line->parameters({{"stop", "stop"}, {"longest", "longest"}, {"shortest", "shortest"}}));
}

void addMountOption(std::optional<SensorMount>* mount, const std::string& otherwise, CommandLine* line) {
  line->addText(
      "mount", "",
      [=](const std::string& text) {
        if (!text.empty()) *mount = mountNamed(text);
      },
      "\"x y yaw\" (m, m, rad): pose of the scanner in the robot's frame; default: " + otherwise);
}

}  // namespace lstm_planner
