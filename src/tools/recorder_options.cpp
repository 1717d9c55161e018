#include "tools/recorder_options.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "tools/ranges.hpp"

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
  line->add("period", &p.period, {1e-4, 3600.0}, "s from step to step");
  line->add("min-step-distance", &p.min_step_distance, {1e-4, 100.0},
            "m; a step is made only when the robot went this far");
  line->add("min-step-turn", &p.min_step_turn, {0.0, M_PI},
            "rad; ... or turned this far in place; 0: that makes no steps");
  line->add("max-gap", &p.max_gap, {0.001, 86400.0}, "s; longer silence ends an episode");
  line->add("max-speed", &p.max_speed, {0.01, 1000.0}, "m/s; odometry that moves faster has jumped");
  line->add("goal-tolerance", &p.goal_tolerance, {0.001, 100.0}, "m; nearer to the goal than this is arrived");
  line->add("delay", &p.delay, {0.0, 3600.0}, "s; how late messages may come and still count");
  line->add("range-cap", &p.range_cap, {0.01, 1000.0}, "m; farther ranges count as this when sectors are averaged");
  line->addText(
      "no-return", noReturnText(p.scan_rules), [&](const std::string& text) { setNoReturn(text, &p.scan_rules); },
      "readings that mean no return besides +inf: \"nan\", \"zero\", \"below\" (range_min), \"beyond\" (range_max), a "
      "number (m); for urg_node: \"nan zero beyond 65.53\"");
  line->add("least-measured", &p.scan_rules.least_measured, {0.01, 1.0},
            "share of the beams in each sector that a scan must have measured to be used");
  line->addFlag("no-scans", &p.keep_scans, false, "keep the sectors only");
}

void addHindsightOptions(HindsightParameters* parameters, CommandLine* line) {
  line->add("stop", &parameters->stop, {0.01, 86400.0}, "s; where the robot stood this long it had arrived");
  line->add("longest", &parameters->longest, {0.01, 1e5}, "m of way; at the latest after this much there was a goal");
  line->add("shortest", &parameters->shortest, {0.01, 1e5}, "m of way; nearer places are not goals");
}

void addMountOption(std::optional<SensorMount>* mount, const std::string& otherwise, CommandLine* line) {
  line->addText(
      "mount", "",
      [=](const std::string& text) {
        if (!text.empty()) *mount = mountNamed(text);
      },
      "\"x y yaw\" (m, m, rad): where the scanner sits in the robot's frame; default: " + otherwise);
}

}  // namespace lstm_planner
