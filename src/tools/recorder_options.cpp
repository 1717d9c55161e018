#include "tools/recorder_options.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace lstm_planner {

namespace po = boost::program_options;

po::typed_value<double>* numberOption(double* value) {
  std::ostringstream text;
  text << *value;
  return po::value(value)->default_value(*value, text.str());
}

void addRecorderOptions(RecorderParameters* parameters, po::options_description* options) {
  RecorderParameters& p = *parameters;
  // clang-format off
  options->add_options()
      ("period", numberOption(&p.period), "s from step to step")
      ("min-step-distance", numberOption(&p.min_step_distance), "m; a step is made only when the robot went this far")
      ("min-step-turn", numberOption(&p.min_step_turn), "rad; ... or turned this far in place; 0: that makes no steps")
      ("max-gap", numberOption(&p.max_gap), "s; longer silence ends an episode")
      ("max-speed", numberOption(&p.max_speed), "m/s; odometry that moves faster has jumped")
      ("goal-tolerance", numberOption(&p.goal_tolerance), "m; nearer to the goal than this is arrived")
      ("delay", numberOption(&p.delay), "s; how late messages may come and still count")
      ("range-cap", numberOption(&p.range_cap), "m; farther ranges count as this when sectors are averaged")
      ("no-return", po::value<std::string>()->default_value(noReturnText(p.scan_rules))->notifier([&p](const std::string& text) {
         setNoReturn(text, &p.scan_rules);
       }), "readings that mean no return besides +inf: \"nan\", \"zero\", \"below\" (range_min), \"beyond\" (range_max), a number (m); for "
           "urg_node: \"nan zero beyond 65.53\"")
      ("least-measured", numberOption(&p.scan_rules.least_measured),
       "share of the beams in each sector that a scan must have measured to be used")
      ("no-scans", po::bool_switch()->notifier([&p](bool without) { p.keep_scans = p.keep_scans && !without; }),
       "keep the sectors only");
  // clang-format on
}

void addHindsightOptions(HindsightParameters* parameters, po::options_description* options) {
  HindsightParameters& p = *parameters;
  // clang-format off
  options->add_options()
      ("stop", numberOption(&p.stop), "s; where the robot stood this long it had arrived")
      ("longest", numberOption(&p.longest), "m of way; at the latest after this much there was a goal")
      ("shortest", numberOption(&p.shortest), "m of way; nearer places are not goals");
  // clang-format on
}

std::optional<SensorMount> mountOption(const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::istringstream stream(text);
  Pose2 pose;
  stream >> pose.x >> pose.y >> pose.yaw;
  if (!stream || !(stream >> std::ws).eof() || !isFinite(pose)) {
    throw std::invalid_argument("option --mount is '" + text + "', expected \"x y yaw\" in m, m and rad");
  }
  return SensorMount{pose, false};
}

}  // namespace lstm_planner
