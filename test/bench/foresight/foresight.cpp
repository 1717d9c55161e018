// What could be foreseen: `lstm_planner_foresight WORLDS COUNT GOALS OUTPUT` drives in COUNT generated worlds of a
// kind, or in a map (map_server yaml, COUNT 1), to GOALS goals each, led by the remembered path, without drift. At
// every step it writes for each way on (eight directions, and along the path) what is known of it, and what it truly
// costs. For foresight.py, which tells how much of the latter the former says.
//
// OUTPUT: a line with the names of the columns, then float32 values, row by row.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/grid/surface_points.hpp"
#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/generated_world.hpp"

namespace lstm_planner {
namespace {

constexpr int kDirections = 8;
constexpr int kPatch = 7;            // places a side of what is known around the border
constexpr double kPatchStep = 0.5;   // m
constexpr double kStep = 0.5;        // m that a way on leads in its direction
constexpr double kSightLine = 10.0;  // m
constexpr double kReach = 12.0;      // m, as far as obstacles are remembered
constexpr double kNearGoal = 1.0;    // m

/// Which places a robot has seen: 0 not yet, 1 free, 2 a wall. World frame.
class SeenPlaces {
 public:
  explicit SeenPlaces(const OccupancyGrid& map)
      : origin_{map.origin().x - kBorder, map.origin().y - kBorder},
        columns_(cells(map.columns() * map.resolution())),
        rows_(cells(map.rows() * map.resolution())),
        seen_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  int at(const Point2& place) const {
    const int index = indexOf(place);
    return index < 0 ? 0 : seen_[static_cast<std::size_t>(index)];
  }

  void look(const World& world, const Pose2& from) {
    constexpr int kBeams = 541;
    constexpr double kIncrement = 1.5 * M_PI / (kBeams - 1);
    ranges_.resize(kBeams);
    const double first = from.yaw - 0.75 * M_PI;
    world.castRays({from.x, from.y}, first, kIncrement, kReach, &ranges_);
    for (int beam = 0; beam < kBeams; ++beam) {
      const double direction = first + beam * kIncrement;
      const double range = ranges_[static_cast<std::size_t>(beam)];
      for (double d = 0.0; d < std::min(range, kReach); d += 0.8 * kCell) mark(pointAlong(from, direction, d), 1);
      if (range < kReach) mark(pointAlong(from, direction, range + 0.2 * kCell), 2);
    }
  }

 private:
  static constexpr double kCell = 0.1;    // m
  static constexpr double kBorder = 5.0;  // m

  static int cells(double length) { return static_cast<int>((length + 2.0 * kBorder) / kCell) + 1; }

  int indexOf(const Point2& place) const {
    const int column = static_cast<int>(std::floor((place.x - origin_.x) / kCell));
    const int row = static_cast<int>(std::floor((place.y - origin_.y) / kCell));
    return column < 0 || row < 0 || column >= columns_ || row >= rows_ ? -1 : row * columns_ + column;
  }

  void mark(const Point2& place, char what) {
    const int index = indexOf(place);
    if (index >= 0) seen_[static_cast<std::size_t>(index)] = std::max(seen_[static_cast<std::size_t>(index)], what);
  }

  Point2 origin_;
  int columns_;
  int rows_;
  std::vector<char> seen_;
  std::vector<double> ranges_;
};

/// The path that a way on takes, and where it leaves what was seen.
struct Border {
  Pose2 pose;              ///< world frame, headed along the path; at the goal where all of the path was seen
  double distance = -1.0;  ///< m along the path
  double unseen = 0.0;     ///< m of the path
  double length = 0.0;     ///< m
};

/// One drive, and what is written of it.
class Observer {
 public:
  Observer(const GridWorld& world, const DriveTask& task, const AgentParameters& parameters, int number)
      : world_(world),
        task_(task),
        number_(number),
        goal_(toLocalFrame(task.start, task.goal)),
        mine_(parameters.memory, parameters.shield),
        truth_(widest(parameters.memory), parameters.shield),
        seen_(world.grid()) {
    std::vector<Point2> obstacles = surfacePoints(world.grid(), 0.5 * parameters.memory.resolution);
    for (Point2& place : obstacles) place = toLocalFrame(task.start, place);
    truth_.know(std::move(obstacles));
  }

  void show(const DriveMoment& moment) {
    if (moment.agent.decision().step == step_) return;
    step_ = moment.agent.decision().step;
    seen_.look(world_, moment.pose);
    const Situation& situation = moment.situation;
    const Point2 here{situation.pose.x, situation.pose.y};
    const double tolerance = moment.agent.parameters().goal_tolerance;
    const bool is_known = mine_.update(situation, goal_, tolerance) == Replanner::Answer::kRoute &&
                          truth_.update(situation, goal_, tolerance) == Replanner::Answer::kRoute;
    if (!is_known || distanceBetween(here, goal_) < kNearGoal) return;
    const Point2 on_path = mine_.pointAhead(kStep);
    std::vector<Point2> rest;
    mine_.pointsAhead(kStep, &rest);
    note(situation.pose, on_path, 0.0, std::move(rest), kDirections);
    for (int i = 0; i < kDirections; ++i) {
      const Point2 next = pointAlong(here, situation.pose.yaw + i * 2.0 * M_PI / kDirections, kStep);
      if (!mine_.isPassable(here, next)) continue;
      std::vector<Point2> path;
      const double regret = mine_.regretOf(here, next, &path);
      if (std::isfinite(regret)) note(situation.pose, next, regret, std::move(path), i);
    }
  }

  static std::vector<std::string> names() {
    std::vector<std::string> names = {
        "drive",         "step",    "way",         "truth",     "regret",         "turn",
        "length",        "unseen",  "all_is_seen", "to_border", "border_to_goal", "border_bends_to_goal",
        "bends_to_goal", "to_goal", "border_ahead"};
    for (int i = 0; i < kPatch * kPatch; ++i) names.push_back("unseen_" + std::to_string(i));
    for (int i = 0; i < kPatch * kPatch; ++i) names.push_back("wall_" + std::to_string(i));
    for (int i = 0; i < kDirections; ++i) names.push_back("sight_" + std::to_string(i));
    return names;
  }

  const std::vector<float>& rows() const { return rows_; }

 private:
  static MemoryParameters widest(MemoryParameters memory) {
    memory.width = kMostSquaresASide * memory.resolution;
    return memory;
  }

  void note(const Pose2& pose, const Point2& next, double regret, std::vector<Point2> path, int way) {
    const Point2 here{pose.x, pose.y};
    std::vector<Point2> unused;
    const double truth = truth_.regretOf(here, next, &unused);
    if (!std::isfinite(truth)) return;
    path.insert(path.begin(), next);
    const Border border = borderOf(path);
    const Point2 border_place = toLocalFrame(task_.start, Point2{border.pose.x, border.pose.y});
    const double border_direction = border.pose.yaw - task_.start.yaw;
    const double direction = directionTo(here, next);
    const bool all_is_seen = border.distance < 0.0;
    add({1.0 * number_, 1.0 * step_, 1.0 * way, truth, regret, normalizeAngle(direction - pose.yaw), border.length,
         border.unseen, all_is_seen ? 1.0 : 0.0, all_is_seen ? border.length : border.distance,
         distanceBetween(border_place, goal_), normalizeAngle(directionTo(border_place, goal_) - border_direction),
         normalizeAngle(directionTo(here, goal_) - direction), distanceBetween(here, goal_),
         normalizeAngle(border_direction - pose.yaw)});
    addPatch(border.pose, 0);
    addPatch(border.pose, 2);
    for (int i = 0; i < kDirections; ++i) add({sightFrom(border.pose, i * 2.0 * M_PI / kDirections)});
  }

  Border borderOf(const std::vector<Point2>& path) const {
    constexpr double kSample = 0.1;  // m
    Border border;
    border.pose = {task_.goal.x, task_.goal.y, 0.0};
    for (std::size_t i = 1; i < path.size(); ++i) {
      const double length = distanceBetween(path[i - 1], path[i]);
      const double direction = length > 0.0 ? directionTo(path[i - 1], path[i]) : 0.0;
      for (double along = 0.0; along < length; along += kSample) {
        const Point2 local = pointAlong(path[i - 1], direction, along);
        const Pose2 place = compose(task_.start, Pose2{local.x, local.y, direction});
        if (seen_.at({place.x, place.y}) != 0) continue;
        border.unseen += kSample;
        if (border.distance < 0.0) {
          border.distance = border.length + along;
          border.pose = place;
        }
      }
      border.length += length;
    }
    return border;
  }

  /// How much around the border is of that kind, of four samples a place.
  void addPatch(const Pose2& border, int kind) {
    constexpr std::array<Point2, 4> kSamples = {{{-0.125, -0.125}, {0.125, -0.125}, {-0.125, 0.125}, {0.125, 0.125}}};
    for (int row = 0; row < kPatch; ++row) {
      for (int column = 0; column < kPatch; ++column) {
        double count = 0.0;
        for (const Point2& sample : kSamples) {
          const Pose2 place = compose(border, Pose2{(column - kPatch / 2) * kPatchStep + sample.x,
                                                    (row - kPatch / 2) * kPatchStep + sample.y, 0.0});
          count += seen_.at({place.x, place.y}) == kind ? 1.0 : 0.0;
        }
        add({count});
      }
    }
  }

  double sightFrom(const Pose2& border, double turn) const {
    constexpr double kSample = 0.1;  // m
    double along = 0.0;
    while (along < kSightLine && seen_.at(pointAlong(border, border.yaw + turn, along)) != 2) along += kSample;
    return along;
  }

  void add(std::initializer_list<double> values) {
    for (const double value : values) rows_.push_back(static_cast<float>(value));
  }

  const GridWorld& world_;
  const DriveTask& task_;
  const int number_;
  const Point2 goal_;
  Replanner mine_;
  Replanner truth_;  ///< knows all obstacles
  SeenPlaces seen_;
  long step_ = -1;
  std::vector<float> rows_;
};

GridWorld worldOf(const std::string& worlds, std::uint64_t seed) {
  if (worlds.find(".yaml") == std::string::npos) return GridWorld(generateWorld(worldKindOf(worlds), seed));
  return GridWorld(readClosedMap(worlds));
}

int run(const std::string& worlds, int count, int goals, const std::string& output) {
  std::ofstream file(output, std::ios::binary);
  const std::vector<std::string> names = Observer::names();
  for (std::size_t i = 0; i < names.size(); ++i) file << (i == 0 ? "" : ",") << names[i];
  file << "\n";
  AgentParameters parameters;
  parameters.leader = Leader::kRoute;
  parameters = fittedToFootprint(parameters);
  DriveParameters rules;
  rules.robot.latency = 0.1;
  for (int number = 0; number < count; ++number) {
    const std::uint64_t seed = worldSeed(WorldUse::kTraining, 1, static_cast<std::uint64_t>(number));
    const GridWorld world = worldOf(worlds, seed);
    int drive_number = number * goals;
    for (const DriveTask& task : drawTasks(world, goals, footprintOf(parameters.shield).circumscribedRadius(),
                                           parameters.shield.clearance, 5.0, seed)) {
      NavigationAgent agent(noPolicy(), parameters);
      Observer observer(world, task, parameters, drive_number);
      drive(world, task, rules, seed + static_cast<std::uint64_t>(drive_number++), &agent,
            [&](const DriveMoment& moment) { observer.show(moment); });
      file.write(reinterpret_cast<const char*>(observer.rows().data()),
                 static_cast<std::streamsize>(observer.rows().size() * sizeof(float)));
    }
  }
  return file ? 0 : 1;
}

}  // namespace
}  // namespace lstm_planner

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: lstm_planner_foresight KIND|MAP.yaml[=FREE_THRESHOLD] WORLDS GOALS OUTPUT\n";
    return 1;
  }
  try {
    return lstm_planner::run(argv[1], std::stoi(argv[2]), std::stoi(argv[3]), argv[4]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
