#include "tools/drive_report.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/simulation/barn.hpp"

namespace lstm_planner {
namespace {

constexpr std::size_t kMostLines = 30;

std::vector<DriveResult> together(const DriveResults& results) {
  std::vector<DriveResult> all;
  for (const auto& world : results) all.insert(all.end(), world.begin(), world.end());
  return all;
}

double meanBarnScore(const std::vector<DriveResult>& results, double k) {
  double sum = 0.0;
  for (const DriveResult& result : results) sum += barnScore(result, k) / static_cast<double>(results.size());
  return sum;
}

bool hasReferencePaths(const std::vector<DriveResult>& results) {
  return std::all_of(results.begin(), results.end(), [](const DriveResult& result) { return result.shortest > 0.0; });
}

void printBarnScore(std::ostream& out, const std::vector<DriveResult>& results) {
  if (!hasReferencePaths(results)) {
    out << "no BARN score: the lengths of the reference paths are not known; models/README.md says how to make "
           "barn_reference_paths.csv\n";
    return;
  }
  out << std::setprecision(4) << "BARN score: " << meanBarnScore(results, 4.0) << " (k = 4), "
      << meanBarnScore(results, 2.0) << " (k = 2)\n";
}

std::string lineOf(const TextTable& table, const std::string& name, const DriveSummary& summary) {
  const auto mean = [&](double value, int decimals, const char* unit = "") {
    return summary.reached > 0 ? fixedText(value, decimals) + unit : "-";
  };
  return table.line({name, std::to_string(summary.goals), std::to_string(summary.reached),
                     std::to_string(summary.contacts), std::to_string(summary.bumped), std::to_string(summary.no_path),
                     std::to_string(summary.timeouts), std::to_string(summary.stuck), std::to_string(summary.elsewhere),
                     mean(summary.mean_ratio, 2), mean(summary.p95_ratio, 2), mean(summary.mean_time, 1, " s")}) +
         '\n';
}

/// The goal's tolerance, and what the robot is wrong about where it is.
void printGoalError(std::ostream& out, const std::vector<DriveResult>& results) {
  const DriveSummary summary = summarize(results);
  if (summary.reached == 0) return;
  out << "where it arrived it stood " << fixedText(summary.mean_goal_error, 2) << " m from the goal on average\n";
}

/// Who decided how many of the steps.
void printLeaders(std::ostream& out, const std::vector<DriveResult>& results) {
  out << "decided by" << std::fixed << std::setprecision(1);
  for (const Decision::Choice& choice : kChoices) {
    const double share = shareOf(choice, results);
    if (share > 0.0) out << "  " << toString(choice) << ' ' << 100.0 * share << " %";
  }
  out << "\n";
}

/// What became of the answers of a network that leads.
void printNetwork(std::ostream& out, const std::vector<DriveResult>& results, bool remembers) {
  double regret = 0.0;
  double driven = 0.0;
  for (const DriveResult& result : results) {
    regret += result.regret;
    driven += result.path_length;
  }
  out << "of the steps without the goal in sight the network decided "
      << 100.0 * shareOutOfSight(Leader::kNetwork, results) << " %; of all steps it ";
  if (remembers) out << "decided " << 100.0 * shareOnPath(results) << " % along the remembered path, and ";
  out << "was overruled by the shield in " << 100.0 * shareOf(Overruled::kByShield, results) << " %";
  if (!remembers) {
    out << "\n";
    return;
  }
  out << ", by the bound in " << 100.0 * shareOf(Overruled::kByBound, results) << " %; its detours were "
      << (driven > 0.0 ? 100.0 * regret / driven : 0.0) << " % of the driven paths\n";
}

/// A line for each class of DynaBARN's worlds.
void printDynaBarn(std::ostream& out, const DriveCourse& course, const DriveResults& results) {
  std::map<DynaBarnClass, std::vector<DriveResult>> classes;
  for (std::size_t i = 0; i < course.worlds.size(); ++i) {
    std::vector<DriveResult>& all = classes[dynaBarnClassOf(course.worlds[i].exercises[0].number)];
    all.insert(all.end(), results[i].begin(), results[i].end());
  }
  for (const auto& [difficulty, all] : classes) {
    const DriveSummary summary = summarize(all);
    const auto drove_into = std::count_if(all.begin(), all.end(), [](const DriveResult& result) {
      return result.end == DriveResult::End::kTouched && result.contacts > 0;
    });
    out << toString(difficulty) << " worlds: " << summary.reached << " of " << summary.goals
        << " reached; ended by touching a cylinder: " << summary.touched << " (the robot drove into " << drove_into
        << " of them)\n";
  }
}

std::string columnName(Decision::Choice choice) {
  std::string name = toString(choice);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

nlohmann::json toJson(const std::vector<DriveResult>& results, bool is_barn) {
  const DriveSummary summary = summarize(results);
  nlohmann::json json = {{"goals", summary.goals},
                         {"reached", summary.reached},
                         {"contacts", summary.contacts},
                         {"bumped", summary.bumped},
                         {"bumped_moving", summary.bumped_moving},
                         {"timeouts", summary.timeouts},
                         {"no_path", summary.no_path},
                         {"stuck", summary.stuck},
                         {"elsewhere", summary.elsewhere},
                         {"mean_ratio", summary.mean_ratio},
                         {"p95_ratio", summary.p95_ratio},
                         {"mean_time_s", summary.mean_time},
                         {"mean_goal_error_m", summary.mean_goal_error}};
  for (const Decision::Choice& choice : kChoices) {
    json["led"][toString(choice)] = shareOf(choice, results);
  }
  json["led_on_path"] = shareOnPath(results);
  json["network_of_steps_out_of_sight"] = shareOutOfSight(Leader::kNetwork, results);
  json["overruled_by_shield"] = shareOf(Overruled::kByShield, results);
  json["overruled_by_bound"] = shareOf(Overruled::kByBound, results);
  if (is_barn && hasReferencePaths(results)) {
    json["barn_score_k4"] = meanBarnScore(results, 4.0);
    json["barn_score_k2"] = meanBarnScore(results, 2.0);
  }
  return json;
}

}  // namespace

const char* toString(DriveResult::End end) {
  constexpr std::array<const char*, 6> kNames = {"reached", "timeout", "no path", "elsewhere", "touched", "stuck"};
  return kNames.at(static_cast<std::size_t>(end));
}

void printDriveSummary(std::ostream& out, const DriveOptions& options, const DriveCourse& course,
                       const DriveResults& results) {
  std::size_t width = 5;
  for (const DriveWorld& world : course.worlds) width = std::max(width, world.name.size());
  const TextTable table(leftText("world", width) +
                        "  goals  reached  contacts  bumped  no path  timeouts  stuck  elsewhere  path / shortest: "
                        "mean    p95  mean time");
  out << table.headings() << '\n';
  if (course.worlds.size() > 1 && course.worlds.size() <= kMostLines) {
    for (std::size_t i = 0; i < course.worlds.size(); ++i) {
      out << lineOf(table, leftText(course.worlds[i].name, width), summarize(results[i]));
    }
  }
  const std::vector<DriveResult> all = together(results);
  out << lineOf(table, leftText(course.worlds.size() == 1 ? course.worlds[0].name : "all", width), summarize(all));
  printGoalError(out, all);
  printLeaders(out, all);
  if (shareOf(Leader::kNetwork, all) > 0.0) printNetwork(out, all, options.agent.memory.enabled);
  if (course.is_barn) printBarnScore(out, all);
  if (course.left_out > 0)
    out << "worlds left out, because the robot does not fit into them: " << course.left_out << '\n';
  if (course.is_dynabarn) printDynaBarn(out, course, results);
}

nlohmann::json driveJson(const DriveOptions& options, const DriveCourse& course, const DriveResults& results) {
  nlohmann::json json = toJson(together(results), course.is_barn);
  const SimulatedRobot::Parameters& robot = course.rules.robot;
  json["map"] = course.source;
  json["left_out"] = course.left_out;
  json["leader"] = nameOfLeader(options.agent.leader);
  json["memory"] = options.agent.memory.enabled;
  json["escape"] = options.agent.escape.enabled;
  json["patience_steps"] = options.agent.escape.patience_steps;
  if (options.agent.leader == Leader::kNetwork) json["model"] = options.model;
  json["seed"] = options.seed;
  json["walkers"] = options.crowd.walkers;
  json["noise_m"] = robot.scanner.noise;
  json["dropout"] = robot.scanner.dropout;
  json["drift"] = robot.base.odometry_error;
  json["slip"] = robot.base.slip;
  json["wheel_error"] = robot.base.drift;
  json["latency_s"] = robot.latency;
  json["evade_time_s"] = options.drive.motion.evade_time;
  json["time_limit_s"] = course.rules.time_limit;
  json["worlds"] = nlohmann::json::array();
  for (std::size_t i = 0; i < course.worlds.size(); ++i) {
    if (results[i].empty()) continue;
    nlohmann::json world = toJson(results[i], course.is_barn);
    world["name"] = course.worlds[i].name;
    json["worlds"].push_back(std::move(world));
  }
  return json;
}

std::string driveCsv(const DriveCourse& course, const DriveResults& results) {
  std::ostringstream text;
  CsvWriter csv(&text);
  csv.add("world", "number", "start_x", "start_y", "start_yaw", "goal_x", "goal_y", "end", "contacts", "bumped",
          "bumped_moving", "time_s", "path_m", "shortest_m", "goal_error_m", "goal_seemed", "steps", "on_path",
          "overruled_by_shield", "overruled_by_bound", "regret_m");
  for (const Decision::Choice& choice : kChoices) csv.add("by_" + columnName(choice));
  csv.endRow();
  for (std::size_t i = 0; i < course.worlds.size(); ++i) {
    for (std::size_t k = 0; k < results[i].size(); ++k) {
      const NumberedDrive& exercise = course.worlds[i].exercises[k];
      const DriveTask& task = exercise.task;
      const DriveResult& result = results[i][k];
      csv.add(course.worlds[i].name, exercise.number, task.start.x, task.start.y, task.start.yaw, task.goal.x,
              task.goal.y, toString(result.end), result.contacts, result.bumped, result.bumped_moving, result.time,
              result.path_length, result.shortest, result.goal_error, toString(result.goal_seemed), result.steps,
              result.steps_on_path, result.overruled[static_cast<std::size_t>(Overruled::kByShield)],
              result.overruled[static_cast<std::size_t>(Overruled::kByBound)], result.regret);
      csv.addAll(result.steps_by);
      csv.endRow();
    }
  }
  return text.str();
}

}  // namespace lstm_planner
