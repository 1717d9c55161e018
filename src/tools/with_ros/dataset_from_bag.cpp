#include <iostream>

#include "lstm_planner/common/words.hpp"
#include "lstm_planner/ros/recorder/bag_drive.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/dataset_conversion.hpp"

namespace lstm_planner {

namespace {

struct FromBagOptions {
  std::vector<std::string> bags;
  std::string output;
  BagDriveOptions drive;
  RecorderParameters recorder;
};

bool readOptions(const std::vector<std::string>& arguments, FromBagOptions* options) {
  BagDriveOptions& drive = options->drive;
  CommandLine line("dataset from-bag",
                   "makes a dataset from bags, as dataset_recorder would have made it from their messages");
  line.addFiles(
          "bag", &options->bags,
          "bags and folders of bags; the word --bag may be left out. A bag that begins within --max-gap of the end of "
          "another one is taken for its next part (rosbag record --split)")
      .required()
      .standsAlone();
  line.addNewFile("output", &options->output, "the new dataset; the file must not exist").required();
  line.add("scan-topic", &drive.scan_topic, "sensor_msgs/LaserScan; default: the bag's only one");
  line.add("odometry-topic", &drive.odometry_topic,
           "nav_msgs/Odometry; default: the bag's only one, or tf if there is none");
  line.add("odometry-frame", &drive.odometry_frame, "frame of the odometry, if it comes from tf");
  line.add("base-frame", &drive.base_frame, "the robot's frame, if the odometry does not name it");
  addMountOption(&drive.mount, "from tf", &line);
  line.add("goal-topic", &drive.goal_topics,
           "geometry_msgs/PoseStamped or move_base_msgs/MoveBaseActionGoal, may be given several times; default: "
           "move_base/goal, move_base_simple/goal and dataset_recorder/goal")
      .oneAtATime();
  line.addFlag("hindsight", &drive.hindsight, true, "the goals are places that the robot reached");
  line.section("with --hindsight");
  visitHindsightParameters(drive.hindsight_parameters, line.everyParameter());
  line.section("steps: the parameters of dataset_recorder");
  addRecorderOptions(&options->recorder, &line);
  line.whenParsed([&] {
    if (!drive.hindsight) line.refuseIdle({"stop", "longest", "shortest"}, "without --hindsight");
  });
  return line.parse(arguments);
}

void print(const BagDriveResult& result, const BagDriveOptions& options) {
  std::cout << "  " << result.duration << " s: " << result.scans << " scans of " << result.scan_topic << ", "
            << result.odometry << " odometry messages of " << result.odometry_source << ", " << result.goals
            << " goals " << (options.hindsight ? "in hindsight" : "of " + joined(result.goal_topics)) << "\n";
  if (result.skipped > 0) {
    std::cout << "  " << result.skipped << " messages are broken: left out, the first on " << result.first_skipped
              << "\n";
  }
}

}  // namespace

int datasetFromBag(const std::vector<std::string>& arguments) {
  FromBagOptions options;
  if (!readOptions(arguments, &options)) return 0;
  const std::vector<BagParts> recordings = bagRecordings(options.bags, options.recorder.max_gap);
  return convertIntoDataset(recordings, options.recorder, options.output, [&](const Parts& parts, RecordingSink* sink) {
    const BagDriveResult result = recordBags(parts, options.drive, options.recorder, sink);
    sink->recording().description.odometry_frame = result.odometry_frame;
    sink->recording().description.begun = utcTime(result.start);
    print(result, options.drive);
  });
}

}  // namespace lstm_planner
