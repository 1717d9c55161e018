#include "tools/drive_options.hpp"

#include <limits>
#include <stdexcept>

#include "lstm_planner/drive/perception/sectors.hpp"
#include "lstm_planner/simulation/generated_world.hpp"
#include "tools/command_line.hpp"
#include "tools/output_file.hpp"
#include "tools/robot_file.hpp"
#include "tools/shared_file.hpp"

namespace lstm_planner {

namespace {

constexpr double kLatency = 0.1;           // s
constexpr double kPatienceDistance = 0.2;  // m a step

void addWorldOptions(DriveOptions* options, CommandLine* line) {
  line->section("the world (with --walkers alone: a walled room of 10 m x 10 m)");
  line->addFiles("map", &options->maps,
                 "map_server yaml files; FILE=0.19 replaces the free_thresh of a map; its unknown cells are solid");
  line->addFile("barn", &options->barn, "barn_cylinders.csv: the BARN worlds, by BARN's rules");
  std::vector<std::string> kinds;
  for (const WorldKind kind : worldKinds()) kinds.emplace_back(toString(kind));
  kinds.emplace_back(kDynaBarn);
  line->addChoice("worlds", &options->kind, kinds,
                  "generated worlds: mazes, offices, corridors, forest, open, rooms or furnished; or dynabarn: "
                  "cylinders that move");
  line->add("walkers", &options->crowd.walkers, {0, 1000}, "people who walk about");
  line->add(
      "goals", &options->goals, kAnyCount,
      "number of drives in each map or in the room (100), or number of worlds with one drive each (100; all of BARN)");
  line->add("only", &options->only, {0, 1e6}, "drive only to the goals, or in the worlds, with these numbers");
  line->add("shortest", &options->shortest, kAnyLength,
            "m; smallest length of the path from start to goal (maps: 2, others: 5)");
  line->add("time-limit", &options->time_limit, kAnyTime,
            "s of simulated time per goal (BARN: 100, room: 120, others: 1800)");
  line->addSeed(&options->seed, "seed of worlds, goals, walkers and noise");
}

void addRobotOptions(DriveOptions* options, CommandLine* line) {
  AgentParameters& agent = options->agent;
  line->section("the robot");
  line->addText(
      "robot", "create2_hokuyo",
      [options](const std::string& name) { readRobotFile(name, &options->drive, &options->agent, &options->model); },
      "name of a file in config/robots, or path of a file of the same form; other options override its values");
  line->addFile("model", &options->model, "ONNX file of the network");
  visitHokuyoParameters(options->drive.robot.scanner,
                        onlyNamed({"noise", "range_step", "dropout"}, line->everyParameter()));
  visitCreate2Parameters(
      options->drive.robot.base,
      line->renamedParameters({{"odometry_error", "drift"}, {"slip", "slip"}, {"drift", "wheel-error"}}));
  visitSimulatedRobotParameters(options->drive.robot, onlyNamed({"latency"}, line->everyParameter()));
  visitMotionParameters(options->drive.motion, line->renamedParameters({{"evade_time", "evade"}}));
  line->addText(
      "leader", nameOfLeader(agent.leader), [&](const std::string& name) { agent.leader = leaderNamed(name); },
      "network; route: the path through the remembered obstacles; none: the allowed angle nearest to the goal's "
      "bearing");
  visitAgentParameters(agent, onlyNamed({"detour/allowance", "detour/share"}, line->everyParameter()));
  line->addFlag("knows-map", &options->knows_map, true,
                "the robot knows all obstacles of --map or --worlds from the start, as far as 50 m; only without "
                "--drift, --slip and --wheel-error");
  line->addFlag("no-drift-correction", &agent.correct_drift, false,
                "take the odometry as it is: do not match scans to take its drift away");
  line->addFlag("no-scan-correction", &options->drive.robot.corrects_scans, false,
                "take scans as they are: do not take the robot's motion out of those of a scanner that turns");
  line->addFlag("no-memory", &agent.memory.enabled, false,
                "remember no obstacles: nothing limits the network's detours, and without progress the robot follows "
                "boundaries");
  line->add("patience", &agent.escape.patience_steps, kAnyCount,
            "steps without progress after which the robot follows boundaries, where no obstacles are remembered; also "
            "after this number times 0.2 m");
  line->addFlag("no-escape", &agent.escape.enabled, false, "never follow boundaries");
  line->addFlag("no-shield", &agent.shield_enabled, false, "switch the shield off");
}

void addOutputOptions(DriveOptions* options, CommandLine* line) {
  line->section("output");
  line->add("threads", &options->threads, kAnyThreads, "number of drives at the same time");
  line->addOutput("json", &options->json, "write the result to this file");
  line->addOutput("details", &options->details, "write one CSV line per goal to this file");
  line->addFolder("pictures", &options->pictures,
                  "draw the failed drives, and the best, the median and the worst one, into this folder");
  line->addOutput("states", &options->states,
                  "PNG file for the drive of --only, with the network's preferences and hidden state step by step");
  line->addFolder("film", &options->film,
                  "draw what the robot knows in the drive of --only, frame by frame, into this folder");
  line->add("film-period", &options->film_parameters.period, {0.1, 1000.0}, "s of simulated time from frame to frame");
  line->add("film-size", &options->film_parameters.longest_side, {100, 4000}, "pixels of a frame's longer side");
}

/// The obstacles are known by odometry, so that has to be right.
void checkKnowsMap(const DriveOptions& options) {
  const Create2Parameters& base = options.drive.robot.base;
  if (options.maps.empty() && (options.kind.empty() || options.kind == kDynaBarn)) {
    throw std::invalid_argument("--knows-map needs --map, or --worlds whose obstacles do not move");
  }
  if (!options.agent.memory.enabled) throw std::invalid_argument("--knows-map and --no-memory exclude each other");
  if (base.odometry_error != 0.0 || base.slip != 0.0 || base.drift != 0.0) {
    throw std::invalid_argument(
        "--knows-map needs odometry without error, expected --drift 0, --slip 0 and --wheel-error 0");
  }
}

/// Throws UnusableScan if the planner would refuse every scan, even that of an open field: the robot would stand until
/// the time limit, and nothing would say why.
void checkView(const HokuyoParameters& scanner) {
  const std::vector<float> ranges(static_cast<std::size_t>(scanner.beams), std::numeric_limits<float>::infinity());
  averageSectors({0.0, scanner.angle_min, scanner.angle_increment, scanner.range_min, scanner.range_max, ranges},
                 scanner.mount, Hokuyo::rules(), scanner.sight);
}

void check(const DriveOptions& options) {
  if (options.knows_map) checkKnowsMap(options);
  const int sources = (options.maps.empty() ? 0 : 1) + (options.barn.empty() ? 0 : 1) + (options.kind.empty() ? 0 : 1);
  if (sources > 1) throw std::invalid_argument("--map, --barn and --worlds exclude each other");
  if (sources == 0 && options.crowd.walkers == 0) {
    throw std::invalid_argument("one of --map, --barn, --worlds and --walkers is needed");
  }
  validate(options.drive.robot.base);
  validate(options.drive.robot.scanner);
  checkView(options.drive.robot.scanner);
  validate(options.drive.motion);
  validate(options.agent);
  if (!options.states.empty() && (options.only.size() != 1 || options.agent.leader != Leader::kNetwork)) {
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
  options->crowd.walkers = 0;
  CommandLine line("drive",
                   "drives a simulated robot (default: a Create 2) to random goals, and prints how well it does");
  addWorldOptions(options, &line);
  addRobotOptions(options, &line);
  addOutputOptions(options, &line);
  line.whenParsed([&] {
    EscapeParameters& escape = options->agent.escape;
    escape.patience_distance = kPatienceDistance * escape.patience_steps;
    options->model = findSharedFile(options->model);
    options->agent = fittedToFootprint(options->agent);
    MemoryParameters& memory = options->agent.memory;
    if (options->knows_map) memory.width = kMostSquaresASide * memory.resolution;
    check(*options);
    if (options->film.empty()) line.refuseIdle({"film-period", "film-size"}, "without --film");
  });
  return line.parse(arguments);
}

}  // namespace lstm_planner
