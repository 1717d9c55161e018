#include <iostream>
#include <optional>

#include "lstm_planner/robot/dataset/carmen_log.hpp"
#include "tools/command_line.hpp"
#include "tools/dataset_commands.hpp"
#include "tools/dataset_conversion.hpp"
#include "tools/recorder_options.hpp"

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
  line.addFiles("log", &options->logs, "logs; --log may be left out").required().standsAlone();
  line.addNewFile("output", &options->output, "the new dataset; there must be no such file").required();
  addMountOption(&options->mount, "from the log", &line);
  line.section("goals: the places that were driven to, for logs name none");
  addHindsightOptions(&options->hindsight, &line);
  line.section("steps, as the parameters of dataset_recorder");
  addRecorderOptions(&options->recorder, &line);
  return line.parse(arguments);
}

void print(const CarmenLog& log) {
  std::cout << "  " << log.duration << " s: " << log.scans << " scans " << log.scan_kind << ", " << log.odometry
            << " lines ODOM\n";
  if (!log.mount_known)
    std::cout << "  where the scanner sits is not in the log: taken as the robot's origin (--mount)\n";
  if (log.late > 0) std::cout << "  " << log.late << " lines were stamped late: they got the time in between\n";
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

}  // namespace

int datasetFromLog(const std::vector<std::string>& arguments) {
  FromLogOptions options;
  if (!readOptions(arguments, &options)) return 0;
  convertIntoDataset(options.logs, options.recorder, options.output, [&](const std::string& path, RecordingSink* sink) {
    const CarmenLog log = readCarmenLog(path, options.mount);
    recordCarmenLog(log, options.hindsight, options.recorder, sink);
    sink->recording().description.odometry_frame = "odom";
    print(log);
  });
  return 0;
}

}  // namespace lstm_planner
