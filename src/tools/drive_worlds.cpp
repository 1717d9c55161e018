#include "tools/drive_worlds.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "lstm_planner/common/words.hpp"
#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/simulation/barn.hpp"
#include "lstm_planner/simulation/generated_world.hpp"

namespace lstm_planner {
namespace {

constexpr int kGoals = 100;
constexpr double kShortest = 5.0;         // m
constexpr double kShortestInMap = 2.0;    // m
constexpr double kTimeLimit = 1800.0;     // s
constexpr double kRoomTimeLimit = 120.0;  // s
constexpr double kRoomSize = 10.0;        // m
constexpr int kDynaBarnWorlds = 3 * kDynaBarnWorldsAClass;
constexpr double kDynaBarnStart = 11.0;   // m, x
constexpr double kDynaBarnGoal = -9.0;    // m, x
constexpr double kDynaBarnArrival = 1.0;  // m from the goal

bool isWanted(const DriveOptions& options, int number) {
  return options.only.empty() || std::find(options.only.begin(), options.only.end(), number) != options.only.end();
}

DriveWorld gridWorld(const std::string& name, OccupancyGrid grid, const DriveOptions& options) {
  auto world = std::make_unique<GridWorld>(std::move(grid));
  DriveWorld result;
  result.name = name;
  result.map = &world->grid();
  if (options.crowd.walkers > 0) result.walker_places = standingPlaces(*world, options.crowd.largest_radius);
  result.world = std::move(world);
  return result;
}

std::vector<DriveTask> draw(const DriveWorld& world, int count, double shortest, std::uint64_t seed,
                            const DriveOptions& options) {
  const ShieldParameters& shield = options.agent.shield;
  try {
    return drawTasks(static_cast<const GridWorld&>(*world.world), count, footprintOf(shield).circumscribedRadius(),
                     shield.clearance, options.shortest.value_or(shortest), seed);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(world.name + ": " + error.what());
  }
}

/// Many goals in one world.
void addGoals(double shortest, const DriveOptions& options, DriveWorld* world) {
  int number = 0;
  for (const DriveTask& task : draw(*world, options.goals.value_or(kGoals), shortest, options.seed, options)) {
    if (isWanted(options, number)) {
      const std::string name = world->name + "-goal-" + std::to_string(number);
      world->exercises.push_back({name, number, task, options.seed + static_cast<std::uint64_t>(number)});
    }
    ++number;
  }
}

/// The map's own, with a number behind it where there is one already: pictures and lines are told apart by it.
std::string nameOfMap(const std::string& text, const std::vector<DriveWorld>& others) {
  const std::string stem = std::filesystem::path(splitFreeThreshold(text).first).stem().string();
  std::string name = stem;
  const auto has_it = [&](const DriveWorld& other) { return other.name == name; };
  for (int i = 2; std::any_of(others.begin(), others.end(), has_it); ++i) name = stem + "-" + std::to_string(i);
  return name;
}

void addMaps(const DriveOptions& options, DriveCourse* course) {
  course->source = joined(options.maps, " ");
  for (const std::string& text : options.maps) {
    const std::string name = nameOfMap(text, course->worlds);
    course->worlds.push_back(gridWorld(name, readClosedMap(text), options));
    addGoals(kShortestInMap, options, &course->worlds.back());
  }
}

void addRoom(const DriveOptions& options, DriveCourse* course) {
  RoomsWorldParameters room;
  room.columns = room.rows = 1;
  room.room_size = kRoomSize;
  course->source = "room";
  course->rules.time_limit = kRoomTimeLimit;
  course->worlds.push_back(gridWorld("room", generateRoomsWorld(room, 1), options));
  addGoals(kShortest, options, &course->worlds.back());
}

/// Without those that the robot is too large for.
void addGeneratedWorlds(const DriveOptions& options, DriveCourse* course) {
  const WorldKind kind = worldKindOf(options.kind);
  course->source = options.kind;
  std::string reason;
  for (int number = 0; number < options.goals.value_or(kGoals); ++number) {
    if (!isWanted(options, number)) continue;
    const std::uint64_t seed = worldSeed(WorldUse::kJudging, options.seed, static_cast<std::uint64_t>(number));
    const std::string name = options.kind + "-" + std::to_string(number);
    DriveWorld world = gridWorld(name, generateWorld(kind, seed), options);
    try {
      world.exercises.push_back({name, number, draw(world, 1, kShortest, seed, options)[0], seed});
    } catch (const std::invalid_argument& error) {
      ++course->left_out;
      reason = error.what();
      continue;
    }
    course->worlds.push_back(std::move(world));
  }
  if (course->worlds.empty() && course->left_out > 0) throw std::invalid_argument(reason);
}

/// Across the square among cylinders that move, by the rules of DynaBARN.
void addDynaBarn(const DriveOptions& options, DriveCourse* course) {
  course->source = kDynaBarn;
  course->is_dynabarn = true;
  course->rules = barnRules(course->rules);
  course->rules.ends_at_touch = true;
  for (int number = 0; number < options.goals.value_or(kDynaBarnWorlds); ++number) {
    if (!isWanted(options, number)) continue;
    const std::uint64_t seed = worldSeed(WorldUse::kJudging, options.seed, static_cast<std::uint64_t>(number));
    const std::string name = std::string(kDynaBarn) + "-" + std::to_string(number);
    course->worlds.push_back(gridWorld(name, cylindersFloor(), options));
    DriveWorld& world = course->worlds.back();
    world.cylinders = drawMovingCylinders(number, seed);
    const DriveTask task{
        {kDynaBarnStart, 0.0, M_PI}, {kDynaBarnGoal, 0.0}, kDynaBarnStart - kDynaBarnGoal - kDynaBarnArrival};
    world.exercises.push_back({name, number, task, seed});
  }
}

void addBarn(const DriveOptions& options, DriveCourse* course) {
  course->source = options.barn;
  course->is_barn = true;
  course->rules = barnRules(course->rules);
  int left = options.goals.value_or(-1);
  for (BarnWorld& barn : readBarnWorlds(options.barn)) {
    if (left-- == 0) break;
    if (!isWanted(options, barn.number)) continue;
    DriveWorld world;
    world.name = "barn-" + std::to_string(barn.number);
    world.world = std::make_unique<CircleWorld>(barn.circles);
    if (options.crowd.walkers > 0) {
      const Point2 low{barn.task.start.x - 2.0, barn.task.start.y};
      const Point2 high{barn.task.start.x + 2.0, barn.task.goal.y};
      world.walker_places = standingPlaces(*world.world, low, high, options.crowd.largest_radius);
    }
    world.circles = std::move(barn.circles);
    world.exercises.push_back(
        {world.name, barn.number, barn.task, options.seed + static_cast<std::uint64_t>(barn.number)});
    course->worlds.push_back(std::move(world));
  }
}

/// Throws when some number that was asked for is no goal's and no world's.
void checkNumbers(const std::vector<int>& wanted, const DriveCourse& course) {
  for (const int number : wanted) {
    const auto hasIt = [number](const DriveWorld& world) {
      return std::any_of(world.exercises.begin(), world.exercises.end(),
                         [number](const auto& exercise) { return exercise.number == number; });
    };
    if (std::none_of(course.worlds.begin(), course.worlds.end(), hasIt)) {
      throw std::invalid_argument(
          "--only is " + std::to_string(number) +
          ", expected the number of a goal, below --goals, or of a world in the file of --barn");
    }
  }
}

}  // namespace

DriveCourse makeDriveCourse(const DriveOptions& options) {
  DriveCourse course;
  course.rules = options.drive;
  course.rules.time_limit = kTimeLimit;
  if (!options.maps.empty()) {
    addMaps(options, &course);
  } else if (!options.barn.empty()) {
    addBarn(options, &course);
  } else if (options.kind == kDynaBarn) {
    addDynaBarn(options, &course);
  } else if (!options.kind.empty()) {
    addGeneratedWorlds(options, &course);
  } else {
    addRoom(options, &course);
  }
  if (options.time_limit) course.rules.time_limit = *options.time_limit;
  checkNumbers(options.only, course);
  return course;
}

}  // namespace lstm_planner
