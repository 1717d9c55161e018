#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/practice/drive_judge.hpp"
#include "lstm_planner/practice/recorded_choices.hpp"
#include "lstm_planner/practice/step_simulator.hpp"
#include "lstm_planner/training/confusion.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/output_file.hpp"
#include "tools/shared_file.hpp"
#include "tools/train_robot.hpp"

namespace lstm_planner {
namespace {

struct JudgeOptions {
  std::string model;
  Leader leader = Leader::kNetwork;
  DriveCourseParameters course;
  int worlds = 252;
  int max_steps = 1000;
  std::uint64_t seed = 1;
  int threads = 2;
  std::vector<std::string> recordings;
  std::string json;
};

void check(const JudgeOptions& options) {
  validate(options.course);
  if (options.leader == Leader::kNetwork && options.model.empty()) {
    throw std::invalid_argument("--model is needed if the network leads");
  }
  if (!options.recordings.empty() && options.leader != Leader::kNetwork) {
    throw std::invalid_argument("--recordings judges a network, --leader is '" + nameOfLeader(options.leader) + "'");
  }
}

bool readOptions(const std::vector<std::string>& arguments, JudgeOptions* options) {
  JudgeOptions& o = *options;
  o.course.shortest = 5.0;
  CommandLine line(
      "judge",
      "prints how well a leader of the robot does alone: no boundary following, four drives per world, random "
      "conditions of sensors, wheels and speed, in worlds that were not used in training");
  line.addFile("model", &o.model, "ONNX file, if the network leads");
  line.addText(
      "leader", nameOfLeader(o.leader), [&](const std::string& name) { o.leader = leaderNamed(name); },
      "who leads: network, route or none");
  addWorldKinds(&o.course.worlds, &line);
  line.add("worlds", &o.worlds, kAnyCount, "number of worlds of all kinds together");
  line.add("max-steps", &o.max_steps, kAnyCount, "largest number of steps of a drive");
  line.add("shortest", &o.course.shortest, {0.001, 1e6}, "m; smallest length of the path to the goal");
  line.addSeed(&o.seed, "seed of worlds, drives and conditions");
  line.add("threads", &o.threads, kAnyThreads, "number of threads; does not change the result");
  line.addFiles(
      "recordings", &o.recordings,
      "datasets of recorded drives: prints how often the network prefers the driver's angle, instead of driving");
  line.addOutput("json", &o.json, "write the result to this file");
  line.whenParsed([&] {
    if (!o.model.empty()) o.model = findSharedFile(o.model);
    check(o);
    if (o.leader != Leader::kNetwork) line.refuseIdle({"model"}, "with --leader " + nameOfLeader(o.leader));
    if (!o.recordings.empty()) {
      line.refuseIdle({"kinds", "worlds", "max-steps", "shortest", "seed", "threads"}, "with --recordings");
    }
  });
  return line.parse(arguments);
}

/// Of a share that was seen in `n` drives, with 95 % (Wilson, "Probable inference", 1927).
std::pair<double, double> intervalOf(double share, double n) {
  constexpr double kZ = 1.96;
  const double middle = (share + kZ * kZ / (2.0 * n)) / (1.0 + kZ * kZ / n);
  const double half = kZ / (1.0 + kZ * kZ / n) * std::sqrt(share * (1.0 - share) / n + kZ * kZ / (4.0 * n * n));
  // Rounding may put an end a little below 0 or above 1.
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

constexpr std::size_t kNameWidth = 10;  ///< of a kind of worlds

struct Sums {
  int drives = 0;
  int arrived = 0;
  double efficiency = 0.0;
  std::map<int, std::pair<int, int>> by_world;  ///< drives and arrivals

  void add(const JudgedDrive& drive) {
    ++drives;
    ++by_world[drive.world].first;
    efficiency += drive.efficiency;
    if (!drive.arrived) return;
    ++arrived;
    ++by_world[drive.world].second;
  }
  double arrival() const { return static_cast<double>(arrived) / drives; }
  double meanEfficiency() const { return efficiency / drives; }

  /// So many drives, each in a world of its own, would tell as much: those in one world are alike (Kish, "Survey
  /// sampling", 1965: design effect, ratio estimate). Where all arrived, or none, only the worlds count.
  double independentDrives() const {
    const auto worlds = static_cast<double>(by_world.size());
    double spread = 0.0;
    for (const auto& [world, counts] : by_world) spread += square(counts.second - arrival() * counts.first);
    const double variance = spread / square(drives) * worlds / (worlds - 1.0);
    if (!(variance > 0.0)) return worlds;
    return std::clamp(arrival() * (1.0 - arrival()) / variance, worlds, static_cast<double>(drives));
  }
};

void print(const TextTable& table, const std::string& name, const Sums& sums) {
  const auto [low, high] = intervalOf(sums.arrival(), sums.independentDrives());
  const std::string arrived = fixedText(100.0 * sums.arrival(), 1) + " %  [" + fixedText(100.0 * low, 1) + ", " +
                              fixedText(100.0 * high, 1) + "]";
  std::cout << table.line({leftText(name, kNameWidth), std::to_string(sums.drives), arrived,
                           fixedText(sums.meanEfficiency(), 3)})
            << "\n";
}

nlohmann::json toJson(const Sums& sums) {
  return {{"drives", sums.drives}, {"arrived", sums.arrived}, {"efficiency", sums.meanEfficiency()}};
}

/// Whatever the network would have come to by itself: at each step it is where the driver was.
void judgeByRecordings(const JudgeOptions& options, const DrivePolicy& policy) {
  const ConfusionMatrix taken = preferencesIn(readDatasetsFor(policy.description(), options.recordings), policy);
  std::cout << taken.sum() << " recorded steps: " << accuracyText(taken) << "\n"
            << "majority-class baseline: " << accuracyText(constantAnswer(taken)) << "\n";
  if (options.json.empty()) return;
  const nlohmann::json json = {{"model", options.model},
                               {"steps", taken.sum()},
                               {"same", taken.trace()},
                               {"balanced_accuracy", balancedAccuracy(taken)}};
  writeJsonFile(options.json, json);
}

}  // namespace

int runJudge(const std::vector<std::string>& arguments) {
  JudgeOptions options;
  if (!readOptions(arguments, &options)) return 0;
  const DrivePolicy policy = options.leader == Leader::kNetwork ? DrivePolicy::fromFile(options.model) : noPolicy();
  if (!options.recordings.empty()) {
    judgeByRecordings(options, policy);
    return 0;
  }
  AgentParameters agent = practiceAgent(policy.description());
  agent.leader = options.leader;
  agent.memory.enabled = options.leader == Leader::kRoute;
  std::vector<Sums> by_kind(options.course.worlds.size());
  Sums all;
  for (const JudgedDrive& drive : judgeEach(policy, agent, options.course, WorldUse::kJudging, options.worlds,
                                            options.max_steps, options.seed, options.threads)) {
    by_kind[drive.kind].add(drive);
    all.add(drive);
  }
  nlohmann::json json = {{"leader", nameOfLeader(options.leader)}, {"model", options.model}, {"seed", options.seed}};
  const TextTable table(leftText("worlds", kNameWidth) + " drives           arrived [95 %]  efficiency");
  std::cout << table.headings() << "\n";
  for (std::size_t kind = 0; kind < by_kind.size(); ++kind) {
    if (by_kind[kind].drives == 0) continue;
    const char* name = toString(options.course.worlds[kind]);
    print(table, name, by_kind[kind]);
    json["worlds"][name] = toJson(by_kind[kind]);
  }
  print(table, "all", all);
  json["worlds"]["all"] = toJson(all);
  if (!options.json.empty()) writeJsonFile(options.json, json);
  return 0;
}

}  // namespace lstm_planner
