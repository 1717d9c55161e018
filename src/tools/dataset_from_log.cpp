#include <algorithm>
#include <iostream>
#include <optional>

#include "lstm_planner/dataset/carmen_log.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/dataset_conversion.hpp"

namespace lstm_planner {

namespace {

struct FromLogOptions {
  std::vector<std::string> logs;
  std::string output;
  std::optional<SensorMount> mount;
  HindsightParameters hindsight;
  RecorderParameters recorder;
};

bool readOptions(const std::vector<std::string>& arguments, FromLogOptions* options) {
  // Published logs are thinned: a scan every metre, or every few seconds.
  options->recorder.max_gap = 10.0;
  options->recorder.scan_rules = carmenLogRules();
  CommandLine line("dataset from-log", "makes a dataset of CARMEN logs (FLASER or ROBOTLASER1, plain or .gz)");
  line.addFiles("log", &options->logs, "the logs; the word --log may be left out").required().standsAlone();
  line.addNewFile("output", &options->output, "the new dataset; the file must not exist").required();
  addMountOption(&options->mount, "from the log", &line);
  line.section("goals: places that the robot reached, because logs have no goals");
  visitHindsightParameters(options->hindsight, line.everyParameter());
  line.section("steps: the parameters of dataset_recorder");
  addRecorderOptions(&options->recorder, &line);
  return line.parse(arguments);
}

void print(const CarmenLog& log) {
  std::cout << "  " << log.duration << " s: " << log.scans << " scans " << log.scan_kind << ", " << log.odometry
            << " lines ODOM\n";
  if (!log.mount_known) std::cout << "  the log has no pose of the scanner: the robot's origin is used (--mount)\n";
  if (log.late > 0) std::cout << "  " << log.late << " lines had late stamps: their times were interpolated\n";
  if (log.repeated > 0) std::cout << "  " << log.repeated << " lines ODOM repeat the scan before them: left out\n";
  if (log.malformed > 0) {
    std::cout << "  " << log.malformed << " lines are malformed, the first: " << log.first_malformed << "\n";
  }
  const char* separator = "  not used: ";
  for (const auto& [kind, count] : log.ignored) {
    std::cout << separator << count << " lines " << kind;
    separator = ", ";
  }
  std::cout << (log.ignored.empty() ? "" : "\n");
}

/// Some mapping programs round the stamps of a log that they correct, until most are the same.
void explainLostTimes(const CarmenLog& log, const Recording& recording) {
  const auto has_steps = [](const RecordedEpisode& episode) { return !episode.steps.empty(); };
  if (std::any_of(recording.episodes.begin(), recording.episodes.end(), has_steps)) return;
  if (2 * log.standing <= log.scans) return;
  std::cout << "  no steps, because the log's times are lost: " << log.standing << " of " << log.scans
            << " scans are stamped no later than the scan before; expected the raw log, with its own stamps\n";
}

}  // namespace

int datasetFromLog(const std::vector<std::string>& arguments) {
  FromLogOptions options;
  if (!readOptions(arguments, &options)) return 0;
  std::vector<Parts> logs;
  for (const std::string& log : options.logs) logs.push_back({log});
  return convertIntoDataset(logs, options.recorder, options.output, [&](const Parts& parts, RecordingSink* sink) {
    const CarmenLog log = readCarmenLog(parts.front(), options.mount);
    recordCarmenLog(log, options.hindsight, options.recorder, sink);
    sink->recording().description.odometry_frame = "odom";
    print(log);
    explainLostTimes(log, sink->recording());
  });
}

}  // namespace lstm_planner
