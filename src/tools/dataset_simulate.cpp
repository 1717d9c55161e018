#include <yaml-cpp/yaml.h>

#include <cmath>
#include <iostream>
#include <stdexcept>

#include "lstm_planner/common/input_file.hpp"
#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/dataset/dataset_summary.hpp"
#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/practice/recorded_drives.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/dataset_conversion.hpp"
#include "tools/dataset_report.hpp"

namespace lstm_planner {

namespace {

constexpr double kWaypointClearance = 0.18;  // m between the footprint and walls
constexpr double kWaypointSpacing = 1.5;     // m

struct SimulateOptions {
  std::vector<std::string> maps;
  std::string waypoints = "20";
  std::uint64_t seed = 1;
  std::string output;
  RecordedDrivesParameters drives;
};

void check(const SimulateOptions& options) {
  const RecordedDrivesParameters& drives = options.drives;
  if (drives.steps < static_cast<long>(options.maps.size())) {
    throw std::invalid_argument("--steps is " + std::to_string(drives.steps) + ", expected at least one for each of " +
                                std::to_string(options.maps.size()) + " maps");
  }
  validate(drives);
  validate(drives.robot.base);
}

bool readOptions(const std::vector<std::string>& arguments, SimulateOptions* options) {
  RecordedDrivesParameters& drives = options->drives;
  drives.robot.base.odometry_error = 0.02;
  drives.recorder.scan_rules = Hokuyo::rules();
  CommandLine line("dataset simulate",
                   "makes a dataset without a robot: a program drives a simulated Create 2 between waypoints");
  line.addFiles("map", &options->maps,
                "map_server yaml files; the steps are divided among them; FILE=0.19 replaces the free_thresh of a map")
      .required();
  line.add("waypoints", &options->waypoints,
           "number of random waypoints in each map, or a yaml file with a list of [x, y] or {x: , y: } (m, map frame), "
           "e.g. the demo's goals");
  line.add("steps", &drives.steps, kAnySteps, "labelled steps to record");
  line.addSeed(&options->seed, "seed of waypoints, goals, driver and noise");
  visitCreate2Parameters(drives.robot.base, line.renamedParameters({{"odometry_error", "drift"}}));
  visitDriverParameters(drives.driver, onlyNamed({"speed", "turn_speed", "wander"}, line.everyParameter()));
  line.addFlag("arcs", &drives.driver.drives_arcs, true, "the driver also presses turn keys while driving forward");
  line.addNewFile("output", &options->output, "the new dataset; the file must not exist").required();
  addRecorderOptions(&drives.recorder, &line);
  line.whenParsed([&] { check(*options); });
  return line.parse(arguments);
}

Point2 waypointOf(const YAML::Node& node) {
  if (node.IsSequence() && node.size() >= 2) return {node[0].as<double>(), node[1].as<double>()};
  if (node.IsMap() && node["x"] && node["y"]) return {node["x"].as<double>(), node["y"].as<double>()};
  throw std::invalid_argument("expected [x, y] or {x: , y: }");
}

std::vector<Point2> readWaypoints(const std::string& path) {
  constexpr std::uintmax_t kLargestFile = 1 << 16;
  std::vector<Point2> points;
  try {
    const YAML::Node file = YAML::Load(readInputFile(path, kLargestFile));
    const YAML::Node list = file.IsSequence() ? file : file["goals"] ? file["goals"] : file["waypoints"];
    if (!list || !list.IsSequence()) throw std::invalid_argument("expected a list, or one called goals or waypoints");
    for (const char* frame : {"frame", "waypoint_frame"}) {
      if (file.IsMap() && file[frame] && file[frame].as<std::string>() != "map") {
        throw std::invalid_argument(std::string(frame) + " is " + file[frame].as<std::string>() + ", expected map");
      }
    }
    for (const YAML::Node& node : list) {
      points.push_back(waypointOf(node));
      if (std::isfinite(points.back().x) && std::isfinite(points.back().y)) continue;
      throw std::invalid_argument("waypoint " + std::to_string(points.size()) + " is not finite");
    }
  } catch (const std::exception& error) {
    throw std::invalid_argument("waypoints of " + path + ": " + error.what());
  }
  return points;
}

std::vector<Point2> waypointsFor(const GridWorld& world, const SimulateOptions& options) {
  const bool is_number = options.waypoints.find_first_not_of("0123456789") == std::string::npos;
  if (!is_number) return readWaypoints(options.waypoints);
  const double radius = options.drives.driver.footprint_radius + kWaypointClearance;
  constexpr std::size_t kMostDigits = 6;
  if (options.waypoints.empty() || options.waypoints.size() > kMostDigits) {
    throw std::invalid_argument("--waypoints is '" + options.waypoints + "', expected a number below a million");
  }
  return drawWaypoints(world, std::stoi(options.waypoints), radius, kWaypointSpacing, options.seed);
}

}  // namespace

int datasetSimulate(const std::vector<std::string>& arguments) {
  SimulateOptions options;
  if (!readOptions(arguments, &options)) return 0;
  Dataset dataset;
  const auto maps = static_cast<long>(options.maps.size());
  for (long i = 0; i < maps; ++i) {
    const GridWorld world(readClosedMap(options.maps[static_cast<std::size_t>(i)]));
    RecordedDrivesParameters drives = options.drives;
    drives.steps = options.drives.steps * (i + 1) / maps - options.drives.steps * i / maps;
    RecordingDescription description;
    description.parameters = drives.recorder;
    description.source = "simulation in " + options.maps[static_cast<std::size_t>(i)];
    description.odometry_frame = "odom";
    RecordingSink sink(description);
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    const RecordedDrives result = recordDrives(world, waypointsFor(world, options), drives, seed, &sink);
    sink.recording().finished = true;
    dataset.recordings.push_back(std::move(sink.recording()));
    std::cout << options.maps[static_cast<std::size_t>(i)] << ": " << result.steps << " steps, " << result.reached
              << " of " << result.goals << " goals reached, " << result.contacts << " contacts, "
              << std::lround(result.path_length) << " m in " << std::lround(result.time) << " s" << std::endl;
  }
  writeDataset(options.output, dataset);
  printLabels(std::cout, summarise(dataset));
  return 0;
}

}  // namespace lstm_planner
