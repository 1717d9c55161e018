#include <iostream>

#include "lstm_planner/ros/recorder/bag_drive.hpp"
#include "tools/dataset_commands.hpp"
#include "tools/dataset_conversion.hpp"
#include "tools/options.hpp"
#include "tools/recorder_options.hpp"

namespace lstm_planner {

namespace po = boost::program_options;

namespace {

struct FromBagOptions {
  std::vector<std::string> bags;
  std::string output;
  std::string mount;
  BagDriveOptions drive;
  RecorderParameters recorder;
};

bool readOptions(const std::vector<std::string>& arguments, FromBagOptions* options) {
  BagDriveOptions& drive = options->drive;
  po::options_description bag("makes a dataset of bags, as dataset_recorder would have made it of their messages");
  // clang-format off
  bag.add_options()
      ("bag", po::value(&options->bags)->required()->composing(), "bags; --bag may be left out")
      ("output", po::value(&options->output)->required(), "the new dataset; there must be no such file")
      ("scan-topic", po::value(&drive.scan_topic), "sensor_msgs/LaserScan; default: the bag's only one")
      ("odometry-topic", po::value(&drive.odometry_topic),
       "nav_msgs/Odometry; default: the bag's only one, or tf where there is none")
      ("odometry-frame", po::value(&drive.odometry_frame)->default_value(drive.odometry_frame),
       "for odometry from tf")
      ("base-frame", po::value(&drive.base_frame)->default_value(drive.base_frame),
       "the robot's, where the odometry does not name it")
      ("mount", po::value(&options->mount),
       "\"x y yaw\" (m, m, rad): where the scanner sits in the base frame; default: from tf")
      ("goal-topic", po::value(&drive.goal_topics)->composing(),
       "geometry_msgs/PoseStamped or move_base_msgs/MoveBaseActionGoal, may be given several times; default: "
       "move_base/goal, move_base_simple/goal and dataset_recorder/goal")
      ("hindsight", po::bool_switch(&drive.hindsight), "goals are the places that were driven to");
  po::options_description hindsight("with --hindsight");
  // clang-format on
  addHindsightOptions(&drive.hindsight_parameters, &hindsight);
  po::options_description recorder("steps, as the parameters of dataset_recorder");
  addRecorderOptions(&options->recorder, &recorder);
  bag.add(hindsight).add(recorder);
  po::variables_map values;
  if (!parseOptions("dataset from-bag", bag, arguments, &values, "bag")) return false;
  drive.mount = mountOption(options->mount);
  return true;
}

std::string listed(const std::vector<std::string>& topics) {
  std::string text;
  for (const std::string& topic : topics) text += (text.empty() ? "" : ", ") + topic;
  return text;
}

void print(const BagDriveResult& result, const BagDriveOptions& options) {
  std::cout << "  " << result.duration << " s: " << result.scans << " scans of " << result.scan_topic << ", "
            << result.odometry << " odometry messages of " << result.odometry_source << ", " << result.goals
            << " goals " << (options.hindsight ? "in hindsight" : "of " + listed(result.goal_topics)) << "\n";
  if (result.skipped > 0) {
    std::cout << "  " << result.skipped << " messages are broken: left out, the first on " << result.first_skipped
              << "\n";
  }
  if (!result.mount_known) {
    std::cout << "  where the scanner sits is not in the bag: taken as the base's origin, looking ahead (--mount)\n";
  }
}

}  // namespace

int datasetFromBag(const std::vector<std::string>& arguments) {
  FromBagOptions options;
  if (!readOptions(arguments, &options)) return 0;
  convertIntoDataset(options.bags, options.recorder, options.output, [&](const std::string& bag, RecordingSink* sink) {
    const BagDriveResult result = recordBag(bag, options.drive, options.recorder, sink);
    sink->recording().description.odometry_frame = result.odometry_frame;
    sink->recording().description.begun = utcTime(result.begun);
    print(result, options.drive);
  });
  return 0;
}

}  // namespace lstm_planner
