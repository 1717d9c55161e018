#include "lstm_planner/simulation/barn.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "lstm_planner/common/csv_file.hpp"
#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {
namespace {

constexpr double kRadius = 0.075;  // m
constexpr Pose2 kStart{-2.25, 3.0, M_PI_2};
constexpr Point2 kGoal{-2.25, 13.0};
constexpr double kTimeLimit = 100.0;         // s
constexpr double kGoalRadius = 1.0;          // m
constexpr double kReferenceSpeed = 2.0;      // m/s
constexpr double kMostReferenceTimes = 8.0;  // times the reference time

int worldNumber(double value, const std::string& path) {
  if (value < 0.0 || value > 1e6 || value != std::floor(value)) {
    throw std::invalid_argument("'" + path + "': a world has the number " + numberText(value) +
                                ", expected a whole number of 0 or more");
  }
  return static_cast<int>(value);
}

}  // namespace

std::vector<BarnWorld> readBarnWorlds(const std::string& path) {
  const CsvFile cylinders(path, {"world", "x", "y"});
  if (cylinders.lines() == 0) throw std::invalid_argument("'" + path + "' holds no cylinder");
  std::map<int, BarnWorld> worlds;
  for (std::size_t line = 0; line < cylinders.lines(); ++line) {
    BarnWorld& world = worlds[worldNumber(cylinders.number(line, 0), path)];
    world.circles.push_back({{cylinders.number(line, 1), cylinders.number(line, 2)}, kRadius});
  }
  std::map<int, double> lengths;
  const std::filesystem::path paths = std::filesystem::path(path).parent_path() / "barn_reference_paths.csv";
  if (std::filesystem::exists(paths)) {
    const CsvFile file(paths.string(), {"world", "path_length_m"});
    for (std::size_t line = 0; line < file.lines(); ++line) {
      lengths[worldNumber(file.number(line, 0), paths.string())] = file.number(line, 1);
    }
  }
  std::vector<BarnWorld> sorted;
  for (auto& [number, world] : worlds) {
    world.number = number;
    world.task = {kStart, kGoal, lengths.count(number) > 0 ? lengths[number] : 0.0};
    sorted.push_back(std::move(world));
  }
  return sorted;
}

DriveParameters barnRules(DriveParameters parameters) {
  parameters.time_limit = kTimeLimit;
  parameters.goal_radius = kGoalRadius;
  parameters.arrival = Arrival::kTruePosition;
  return parameters;
}

double barnScore(const DriveResult& result, double k) {
  const double reference = result.shortest / kReferenceSpeed;
  if (result.end != DriveResult::End::kReached || result.contacts > 0 || !(reference > 0.0)) return 0.0;
  return reference / std::clamp(result.time, k * reference, kMostReferenceTimes * reference);
}

}  // namespace lstm_planner
