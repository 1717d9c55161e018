#include "tools/drive_options.hpp"

#include <sstream>
#include <stdexcept>

#include "lstm_planner/robot/simulation/generated_world.hpp"
#include "tools/options.hpp"
#include "tools/output_file.hpp"

namespace lstm_planner {

namespace po = boost::program_options;

namespace {

constexpr double kLatency = 0.1;  // s

/// An option whose default is the value that is there.
template <typename T>
auto withDefault(T* value) {
  std::ostringstream text;  // boost's own would be 0.10000000000000001
  text << *value;
  return po::value(value)->default_value(*value, text.str());
}

/// An option without a default.
template <typename T>
auto optional(std::optional<T>* value) {
  return po::value<T>()->notifier([value](const T& given) { *value = given; });
}

void addWorldOptions(DriveOptions* options, po::options_description* all) {
  po::options_description description("where (without any of the first three: a walled room of 10 m x 10 m)");
  // clang-format off
  description.add_options()
      ("map", po::value(&options->maps)->multitoken(),
       "map_server yaml files; FILE=0.19 replaces the free_thresh of one of them")
      ("barn", po::value(&options->barn), "barn_cylinders.csv: the BARN worlds, by BARN's rules")
      ("worlds", po::value(&options->kind), "generated worlds: mazes, offices, corridors, forest, open or rooms")
      ("walkers", withDefault(&options->crowd.walkers), "people who walk about in each world")
      ("free-threshold", withDefault(&options->free_threshold), "replaces the free_thresh of all maps")
      ("open-unknown", "what a map does not know can be seen and driven through; it is solid otherwise")
      ("goals", optional(&options->goals),
       "starts and goals in each map or in the room (100), or number of worlds with one each (100; all of BARN)")
      ("only", po::value(&options->only)->multitoken(), "drive only the goals, or worlds, of these numbers")
      ("shortest", optional(&options->shortest), "m, shortest way from start to goal (maps: 2, others: 5)")
      ("time-limit", optional(&options->time_limit),
       "s of simulated time a goal (BARN: 100, room: 120, others: 1800)")
      ("seed", withDefault(&options->seed), "of worlds, goals, walkers and noise");
  // clang-format on
  all->add(description);
}

void addRobotOptions(DriveOptions* options, po::options_description* all) {
  HokuyoParameters& scanner = options->drive.robot.scanner;
  Create2Parameters& base = options->drive.robot.base;
  po::options_description description("the robot");
  // clang-format off
  description.add_options()
      ("model", withDefault(&options->model), "ONNX file that drives")
      ("noise", withDefault(&scanner.noise), "m, standard deviation of a range up to 10 m; three times that beyond")
      ("dropout", withDefault(&scanner.dropout), "probability of a lost beam")
      ("drift", withDefault(&base.odometry_error), "of the odometry, as a share of the way: 0.02 = 2 %")
      ("slip", withDefault(&base.slip), "standard deviation of a wheel's slip")
      ("wheel-error", withDefault(&base.drift), "relative error between the wheels")
      ("latency", withDefault(&options->drive.robot.latency), "s from a command to the wheels")
      ("leader", po::value<std::string>()->default_value(toString(options->agent.leader)),
       "network; route: the way through what is remembered; none: the allowed angle nearest to the goal's bearing")
      ("patience", withDefault(&options->agent.escape.patience_steps),
       "steps without progress after which the rescue leads; likewise so many times 0.2 m")
      ("no-escape", "switch the rescue off: whoever leads has no help")
      ("no-memory", "remember no obstacles: the rescue follows boundaries")
      ("no-shield", "switch the shield off");
  // clang-format on
  all->add(description);
}

void addOutputOptions(DriveOptions* options, po::options_description* all) {
  po::options_description description("what comes out");
  // clang-format off
  description.add_options()
      ("threads", withDefault(&options->threads), "drives at a time")
      ("json", po::value(&options->json), "write the result to this file")
      ("details", po::value(&options->details), "write a CSV line a goal to this file")
      ("pictures", po::value(&options->pictures),
       "draw the drives that went wrong, the best, the middle and the worst into this folder")
      ("states", po::value(&options->states),
       "PNG file: the one drive of --only, with the network's preferences and hidden state step by step");
  // clang-format on
  all->add(description);
}

void check(const DriveOptions& options) {
  const int sources = (options.maps.empty() ? 0 : 1) + (options.barn.empty() ? 0 : 1) + (options.kind.empty() ? 0 : 1);
  if (sources > 1) throw std::invalid_argument("--map, --barn and --worlds exclude each other");
  if (sources == 0 && options.crowd.walkers == 0) {
    throw std::invalid_argument("one of --map, --barn, --worlds and --walkers is needed");
  }
  if (!options.kind.empty()) worldKindOf(options.kind);
  if (options.goals.value_or(1) < 1 || options.threads < 1) {
    throw std::invalid_argument("--goals and --threads must be at least 1");
  }
  if (!(options.shortest.value_or(1.0) >= 0.0)) throw std::invalid_argument("--shortest must be 0 or more");
  if (!(options.time_limit.value_or(1.0) > 0.0)) throw std::invalid_argument("--time-limit must be more than 0");
  validate(options.crowd);
  validate(options.drive.robot.base);
  validate(options.drive.robot.scanner);
  validate(options.agent);
  for (const std::string& file : {options.json, options.details}) {
    if (!file.empty()) checkWritable(file);
  }
  if (!options.states.empty()) {
    checkWritable(options.states);
    if (options.only.size() != 1 || options.agent.leader != Leader::kNetwork) {
      throw std::invalid_argument("--states draws one drive: it needs --only with one number, and a network that leads");
    }
  }
  if (!options.pictures.empty()) makeOutputFolder(options.pictures);
}

}  // namespace

bool readDriveOptions(const std::vector<std::string>& arguments, DriveOptions* options) {
  options->drive.robot.latency = kLatency;
  options->agent.leader = kDefaultLeader;
  options->crowd.walkers = 0;
  po::options_description description("drives a simulated Create 2 to random goals and judges it");
  addWorldOptions(options, &description);
  addRobotOptions(options, &description);
  addOutputOptions(options, &description);
  po::variables_map values;
  if (!parseOptions("drive", description, arguments, &values)) return false;
  options->agent.leader = leaderNamed(values["leader"].as<std::string>());
  options->agent.escape.enabled = values.count("no-escape") == 0;
  options->agent.escape.patience_distance = 0.2 * options->agent.escape.patience_steps;
  options->agent.memory.enabled = values.count("no-memory") == 0;
  options->open_unknown = values.count("open-unknown") != 0;
  options->agent.shield_enabled = values.count("no-shield") == 0;
  check(*options);
  return true;
}

}  // namespace lstm_planner
