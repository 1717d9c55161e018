#include "lstm_planner/practice/drive_course.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/simulation/standing_cells.hpp"

namespace lstm_planner {
namespace {

/// m between footprint and walls where a drive starts or ends.
constexpr double kClearance = 0.12;

/// m; a start this near to the goal is no dead end.
constexpr double kNearGoal = 1.5;

double neededDistance(const GridWorld& world) { return distanceNeeded(kPracticeRadius + kClearance, world.grid()); }

/// Fills the tasks of an exercise; false when hardly any place leads to the goal.
bool drawStarts(const DriveCourseParameters& parameters, const std::vector<CellIndex>& standing, int starts,
                Random& random, const Point2& goal, DriveExercise* exercise) {
  const OccupancyGrid& grid = exercise->world->grid();
  const double needed = neededDistance(*exercise->world);
  for (int failures = 0; static_cast<int>(exercise->tasks.size()) < starts;) {
    CellIndex cell = standing[uniformIndex(random, standing.size())];
    if (uniform(random) < parameters.dead_end_share) {
      const CellIndex end = deadEndBelow(*exercise->world, cell, goal, needed);
      if (distanceBetween(grid.centerOf(end), goal) > kNearGoal) cell = end;
    }
    const Point2 start = grid.centerOf(cell);
    const double length = exercise->teacher->distanceToGo(start);
    const double yaw = uniform(random, -M_PI, M_PI);
    if (std::isfinite(length) && length >= parameters.shortest) {
      exercise->tasks.push_back({{start.x, start.y, yaw}, goal, length});
    } else if (++failures > 50 * starts) {
      return false;
    }
  }
  return true;
}

}  // namespace

void validate(const DriveCourseParameters& parameters) {
  if (parameters.worlds.empty()) throw std::invalid_argument("worlds is empty, expected at least one kind");
  checkPositive("shortest", parameters.shortest);
  checkParameter(parameters.dead_end_share >= 0.0 && parameters.dead_end_share <= 1.0, "dead_end_share",
                 parameters.dead_end_share, "a share in [0, 1]");
}

std::vector<DriveExercise> makeDriveExercises(const DriveCourseParameters& parameters, WorldUse use, std::uint64_t seed,
                                              int number, int goals, int starts) {
  constexpr int kTries = 10;
  const std::uint64_t world_seed = worldSeed(use, seed, static_cast<std::uint64_t>(number));
  Random random(~world_seed);
  const std::size_t kind = static_cast<std::size_t>(number) % parameters.worlds.size();
  const auto world = std::make_shared<const GridWorld>(generateWorld(parameters.worlds[kind], world_seed));
  const std::vector<CellIndex> standing = standingCells(world->grid(), world->distances(), neededDistance(*world));
  if (standing.empty()) throw std::runtime_error("a generated world has no place for the robot");
  std::vector<DriveExercise> exercises;
  for (int trial = 0; trial < kTries * goals && static_cast<int>(exercises.size()) < goals; ++trial) {
    DriveExercise exercise;
    exercise.kind = kind;
    exercise.world = world;
    const Point2 goal = world->grid().centerOf(standing[uniformIndex(random, standing.size())]);
    exercise.teacher = std::make_unique<const Teacher>(*world, goal);
    if (drawStarts(parameters, standing, starts, random, goal, &exercise)) exercises.push_back(std::move(exercise));
  }
  return exercises;
}

CellIndex deadEndBelow(const GridWorld& world, CellIndex start, const Point2& goal, double clearance) {
  CellIndex here = start;
  double distance = distanceBetween(world.grid().centerOf(here), goal);
  for (bool nearer = true; nearer;) {
    nearer = false;
    const CellIndex from = here;
    for (int row = from.row - 1; row <= from.row + 1; ++row) {
      for (int column = from.column - 1; column <= from.column + 1; ++column) {
        const CellIndex cell{column, row};
        if (world.distances().at(cell) < clearance) continue;
        const double next = distanceBetween(world.grid().centerOf(cell), goal);
        if (next >= distance) continue;
        here = cell;
        distance = next;
        nearer = true;
      }
    }
  }
  return here;
}

}  // namespace lstm_planner
