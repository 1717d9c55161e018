#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/practice/teacher.hpp"
#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/generated_world.hpp"
#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner {

/// In which worlds and on which paths the robot learns.
struct DriveCourseParameters {
  std::vector<WorldKind> worlds = worldKinds();  ///< kinds of generated worlds, one after the other
  double shortest = 2.0;                         ///< m; the path from start to goal is at least this long
  double dead_end_share = 0.0;                   ///< share of drives that start in a dead end (thesis ch. 5)
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const DriveCourseParameters& parameters);

/// A goal in a generated world, the teacher that knows the path to it, and where to start from.
struct DriveExercise {
  std::size_t kind = 0;  ///< index in DriveCourseParameters::worlds
  std::shared_ptr<const GridWorld> world;
  std::unique_ptr<const Teacher> teacher;
  std::vector<DriveTask> tasks;  ///< all with the same goal
};

/// The `number`-th world for a use, with up to `goals` goals of `starts` drives each; the same for the same seed.
/// Throws std::runtime_error if the world has no place for the robot.
std::vector<DriveExercise> makeDriveExercises(const DriveCourseParameters& parameters, WorldUse use, std::uint64_t seed,
                                              int number, int goals, int starts);

/// The cell where a robot stops that moves from `start` cell by cell to the neighbour nearest to the goal (world
/// frame), as long as one is nearer. It keeps at least `clearance` (m) from all obstacles.
CellIndex deadEndBelow(const GridWorld& world, CellIndex start, const Point2& goal, double clearance);

}  // namespace lstm_planner
