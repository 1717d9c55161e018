#include "tools/drive_options.hpp"

#include <stdexcept>

#include "lstm_planner/robot/simulation/generated_world.hpp"
#include "tools/command_line.hpp"
#include "tools/output_file.hpp"
#include "tools/ranges.hpp"
#include "tools/robot_file.hpp"
#include "tools/shared_file.hpp"

namespace lstm_planner {

namespace {

constexpr double kLatency = 0.1;           // s
constexpr double kPatienceDistance = 0.2;  // m a step

void addWorldOptions(DriveOptions* options, CommandLine* line) {
  line->section("where (without any of the first three: a walled room of 10 m x 10 m)");
  line->addFiles("map", &options->maps, "map_server yaml files; FILE=0.19 replaces the free_thresh of one of them");
  line->addFile("barn", &options->barn, "barn_cylinders.csv: the BARN worlds, by BARN's rules");
  line->add("worlds", &options->kind, "generated worlds: mazes, offices, corridors, forest, open or rooms");
  visitCrowdParameters(options->crowd, line->parameters({{"walkers", "walkers"}}));
  line->add("free-threshold", &options->free_threshold, {-1.0, 1.0},
            "replaces the free_thresh of all maps; -1: it does not");
  line->addFlag("open-unknown", &options->open_unknown, true,
                "what a map does not know can be seen and driven through; it is solid otherwise");
  line->add("goals", &options->goals, kAnyCount,
            "starts and goals in each map or in the room (100), or number of worlds with one each (100; all of BARN)");
  line->add("only", &options->only, {0, 1e6}, "drive only the goals, or worlds, of these numbers");
  line->add("shortest", &options->shortest, kAnyLength, "m, shortest path from start to goal (maps: 2, others: 5)");
  line->add("time-limit", &options->time_limit, kAnyTime,
            "s of simulated time a goal (BARN: 100, room: 120, others: 1800)");
  line->addSeed(&options->seed, "of worlds, goals, walkers and noise");
}

void addRobotOptions(DriveOptions* options, CommandLine* line) {
  AgentParameters& agent = options->agent;
  line->section("the robot");
  line->addText(
      "robot", "create2_hokuyo",
      [options](const std::string& name) { readRobotFile(name, &options->drive, &options->agent); },
      "a file of config/robots by its name, or another one of that form; options set together with it count more");
  line->addFile("model", &options->model, "ONNX file that drives");
  visitHokuyoParameters(options->drive.robot.scanner, line->parameters({{"noise", "noise"}, {"dropout", "dropout"}}));
  visitCreate2Parameters(options->drive.robot.base,
                         line->parameters({{"odometry_error", "drift"}, {"slip", "slip"}, {"drift", "wheel-error"}}));
  visitSimulatedRobotParameters(options->drive.robot,
                                line->parameters({{"latency", "latency"}, {"localisation_jump", "localisation"}}));
  line->addText(
      "leader", nameOfLeader(agent.leader), [&](const std::string& name) { agent.leader = leaderNamed(name); },
      "network; route: the path through what is remembered; none: the allowed angle nearest to the goal's bearing");
  line->add("patience", &agent.escape.patience_steps, kAnyCount,
            "steps without progress after which the rescue leads; likewise so many times 0.2 m");
  line->addFlag("no-escape", &agent.escape.enabled, false, "switch the rescue off: whoever leads has no help");
  line->addFlag("no-memory", &agent.memory.enabled, false, "remember no obstacles: the rescue follows boundaries");
  line->addFlag("no-shield", &agent.shield_enabled, false, "switch the shield off");
}

void addOutputOptions(DriveOptions* options, CommandLine* line) {
  line->section("what comes out");
  line->add("threads", &options->threads, kAnyThreads, "drives at a time");
  line->addOutput("json", &options->json, "write the result to this file");
  line->addOutput("details", &options->details, "write a CSV line a goal to this file");
  line->addFolder("pictures", &options->pictures,
                  "draw the drives that went wrong, the best, the middle and the worst into this folder");
  line->addOutput("states", &options->states,
                  "PNG file: the one drive of --only, with the network's preferences and hidden state step by step");
  line->addFolder("film", &options->film,
                  "draw the one drive of --only as the robot knows it, frame by frame, into this folder");
  line->add("film-period", &options->film_parameters.period, {0.1, 1000.0}, "s of simulated time from frame to frame");
  line->add("film-size", &options->film_parameters.longest_side, {100, 4000}, "pixels of a frame's longer side");
}

void check(const DriveOptions& options) {
  const int sources = (options.maps.empty() ? 0 : 1) + (options.barn.empty() ? 0 : 1) + (options.kind.empty() ? 0 : 1);
  if (sources > 1) throw std::invalid_argument("--map, --barn and --worlds exclude each other");
  if (sources == 0 && options.crowd.walkers == 0) {
    throw std::invalid_argument("one of --map, --barn, --worlds and --walkers is needed");
  }
  if (!options.kind.empty()) worldKindOf(options.kind);
  validate(options.crowd);
  validate(options.drive.robot.base);
  validate(options.drive.robot.scanner);
  validate(options.drive.motion);
  validate(options.agent);
  if (!options.states.empty() && (options.only.size() != 1 || options.agent.leader != Decision::Source::kNetwork)) {
    throw std::invalid_argument("--states draws one drive: it needs --only with one number, and a network that leads");
  }
  if (!options.film.empty() && options.only.size() != 1) {
    throw std::invalid_argument("--film shows one drive: it needs --only with one number");
  }
  if (!options.film.empty()) makeOutputFolder(options.film);
  if (!options.pictures.empty()) makeOutputFolder(options.pictures);
}

}  // namespace

bool readDriveOptions(const std::vector<std::string>& arguments, DriveOptions* options) {
  options->drive.robot.latency = kLatency;
  options->agent.leader = kDefaultLeader;
  options->crowd.walkers = 0;
  CommandLine line("drive",
                   "drives a simulated robot, a Create 2 unless told otherwise, to random goals and judges it");
  addWorldOptions(options, &line);
  addRobotOptions(options, &line);
  addOutputOptions(options, &line);
  line.whenParsed([&] {
    EscapeParameters& escape = options->agent.escape;
    escape.patience_distance = kPatienceDistance * escape.patience_steps;
    options->model = findSharedFile(options->model);
    options->agent = fittedToFootprint(options->agent);
    check(*options);
  });
  return line.parse(arguments);
}

}  // namespace lstm_planner
