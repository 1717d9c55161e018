#include <atomic>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "learning/parallel_for.hpp"
#include "lstm_planner/evaluation/drive.hpp"
#include "lstm_planner/evaluation/trace_picture.hpp"
#include "lstm_planner/grid/map_server_map.hpp"
#include "tools/command.hpp"
#include "tools/options.hpp"
#include "tools/progress.hpp"

namespace lstm_planner {

namespace {

struct DriveOptions {
  std::string map;
  std::string model = "models/create2_lstm_2x8.onnx";
  std::string json;
  std::string details;
  std::string pictures;
  double free_threshold = -1.0;
  int goals = 100;
  std::uint64_t seed = 1;
  int threads = 2;
  double shortest = 2.0;
  DriveParameters drive;
  AgentParameters agent;
};

bool readOptions(const std::vector<std::string>& arguments, DriveOptions* options) {
  namespace po = boost::program_options;
  HokuyoParameters& scanner = options->drive.robot.scanner;
  Create2Parameters& base = options->drive.robot.base;
  options->drive.robot.latency = 0.1;
  po::options_description description;
  // clang-format off
  description.add_options()
      ("map", po::value(&options->map)->required(), "map_server yaml file")
      ("free-threshold", po::value(&options->free_threshold), "replaces the map's free_thresh")
      ("model", po::value(&options->model)->default_value(options->model), "ONNX file that drives")
      ("goals", po::value(&options->goals)->default_value(options->goals), "number of random starts and goals")
      ("shortest", po::value(&options->shortest)->default_value(options->shortest), "m, shortest way between them")
      ("seed", po::value(&options->seed)->default_value(options->seed), "of goals and noise")
      ("time-limit", po::value(&options->drive.time_limit)->default_value(options->drive.time_limit),
       "s of simulated time a goal")
      ("noise", po::value(&scanner.noise)->default_value(scanner.noise), "m, standard deviation of a range")
      ("dropout", po::value(&scanner.dropout)->default_value(scanner.dropout), "probability of a lost beam")
      ("slip", po::value(&base.slip)->default_value(base.slip), "standard deviation of a wheel's slip")
      ("wheel-error", po::value(&base.drift)->default_value(base.drift), "relative error between the wheels")
      ("drift", po::value(&base.odometry_error)->default_value(base.odometry_error),
       "of the odometry, as a share of the way: 0.02 = 2 %")
      ("latency", po::value(&options->drive.robot.latency)->default_value(options->drive.robot.latency),
       "s from a command to the wheels")
      ("no-escape", "switch the escape off")
      ("no-shield", "switch the shield off")
      ("threads", po::value(&options->threads)->default_value(options->threads), "drives at a time")
      ("json", po::value(&options->json), "write the result to this file")
      ("details", po::value(&options->details), "write a CSV line a goal to this file")
      ("pictures", po::value(&options->pictures), "draw the missed goals and the longest detour into this folder");
  // clang-format on
  po::variables_map values;
  if (!parseOptions("drive", description, arguments, &values)) {
    return false;
  }
  options->agent.escape.enabled = values.count("no-escape") == 0;
  options->agent.shield_enabled = values.count("no-shield") == 0;
  if (options->goals < 1 || options->threads < 1) {
    throw std::invalid_argument("--goals and --threads must be at least 1");
  }
  return true;
}

std::vector<DriveResult> driveAll(const DriveOptions& options, const GridWorld& world,
                                  const std::vector<DriveTask>& tasks) {
  const DrivePolicy policy = DrivePolicy::fromFile(options.model);
  std::vector<DriveResult> results(tasks.size());
  Progress progress;
  std::atomic<int> done{0};
  parallelFor(static_cast<int>(tasks.size()), options.threads, [&](int task, int thread) {
    NavigationAgent agent(policy, options.agent);
    const auto i = static_cast<std::size_t>(task);
    results[i] = drive(world, tasks[i], options.drive, options.seed + i, &agent);
    ++done;
    if (thread == 0) {
      progress.show(static_cast<double>(done) / static_cast<double>(tasks.size()));
    }
  });
  progress.show(1.0);
  return results;
}

const char* toString(DriveResult::End end) {
  switch (end) {
    case DriveResult::End::kReached:
      return "reached";
    case DriveResult::End::kTimeout:
      return "timeout";
    case DriveResult::End::kNoWay:
      return "no way";
    case DriveResult::End::kElsewhere:
      return "elsewhere";
  }
  return "";
}

void writeDetails(const std::string& path, const std::vector<DriveTask>& tasks,
                  const std::vector<DriveResult>& results) {
  std::ofstream file(path);
  file << "start_x,start_y,start_yaw,goal_x,goal_y,end,contacts,time_s,path_m,shortest_m,steps,escape_steps\n";
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const DriveTask& task = tasks[i];
    const DriveResult& result = results[i];
    file << task.start.x << ',' << task.start.y << ',' << task.start.yaw << ',' << task.goal.x << ',' << task.goal.y
         << ',' << toString(result.end) << ',' << result.contacts << ',' << result.time << ',' << result.path_length
         << ',' << result.shortest << ',' << result.steps << ',' << result.escape_steps << '\n';
  }
  if (!file.flush()) {
    throw std::runtime_error("cannot write " + path);
  }
}

void writeJson(const std::string& path, const DriveOptions& options, const DriveSummary& summary) {
  const nlohmann::json json = {{"map", options.map},
                                       {"model", options.model},
                                       {"seed", options.seed},
                                       {"goals", summary.goals},
                                       {"reached", summary.reached},
                                       {"contacts", summary.contacts},
                                       {"timeouts", summary.timeouts},
                                       {"no_way", summary.no_way},
                                       {"mean_ratio", summary.mean_ratio},
                                       {"p95_ratio", summary.p95_ratio},
                                       {"mean_time_s", summary.mean_time}};
  std::ofstream file(path);
  file << json.dump(2) << '\n';
  if (!file.flush()) {
    throw std::runtime_error("cannot write " + path);
  }
}

void draw(const std::string& path, const GridWorld& world, const DriveTask& task, const DriveResult& result) {
  TracePicture picture;
  picture.starts = {task.start};
  picture.goals = {{task.goal, toString(result.end), result.end == DriveResult::End::kReached}};
  picture.traces.emplace_back();
  for (const Pose2& pose : result.trace) {
    picture.traces.back().push_back({pose.x, pose.y});
  }
  writeTracePicture(path, world.grid(), picture);
}

void drawPictures(const std::string& folder, const GridWorld& world, const std::vector<DriveTask>& tasks,
                  const std::vector<DriveResult>& results) {
  std::size_t longest = 0;
  const auto ratio = [&](std::size_t i) { return results[i].path_length / results[i].shortest; };
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (results[i].end != DriveResult::End::kReached) {
      draw(folder + "/missed_" + std::to_string(i) + ".png", world, tasks[i], results[i]);
    } else if (results[longest].end != DriveResult::End::kReached || ratio(i) > ratio(longest)) {
      longest = i;
    }
  }
  draw(folder + "/longest_detour_" + std::to_string(longest) + ".png", world, tasks[longest], results[longest]);
}

}  // namespace

int runDrive(const std::vector<std::string>& arguments) {
  DriveOptions options;
  if (!readOptions(arguments, &options)) {
    return 0;
  }
  const GridWorld world(readMapServerMap(options.map, options.free_threshold));
  const ShieldParameters& shield = options.agent.shield;
  const std::vector<DriveTask> tasks =
      drawTasks(world, options.goals, shield.footprint_radius, shield.clearance, options.shortest, options.seed);
  const std::vector<DriveResult> results = driveAll(options, world, tasks);
  const DriveSummary summary = summarize(results);
  std::cout << std::fixed << std::setprecision(2) << "goals " << summary.goals << ", reached " << summary.reached
            << ", contacts " << summary.contacts << ", no way " << summary.no_way << ", timeouts " << summary.timeouts
            << ", path / shortest: mean " << summary.mean_ratio << ", 95 % below " << summary.p95_ratio
            << ", mean time " << summary.mean_time << " s\n";
  if (!options.details.empty()) {
    writeDetails(options.details, tasks, results);
  }
  if (!options.pictures.empty()) {
    drawPictures(options.pictures, world, tasks, results);
  }
  if (!options.json.empty()) {
    writeJson(options.json, options, summary);
  }
  return 0;
}

}  // namespace lstm_planner
