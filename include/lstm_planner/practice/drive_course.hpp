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

/// In which worlds is learned, and which paths.
struct DriveCourseParameters {
  std::vector<WorldKind> worlds = worldKinds();  ///< kinds of generated worlds, in turn
  double shortest = 2.0;                         ///< m, of the shortest path from start to goal
  double dead_end_share = 0.0;                   ///< of the drives that start in a dead end (thesis ch. 5)
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
std::vector<DriveExercise> makeDriveExercises(const DriveCourseParameters& parameters, WorldUse use, std::uint64_t seed,
                                              int number, int goals, int starts);

/// Where a robot ends that goes from `start` nearer and nearer to the goal as the crow flies: places at least
/// `clearance` (m) from all obstacles, in steps of a cell.
CellIndex deadEndBelow(const GridWorld& world, CellIndex start, const Point2& goal, double clearance);

}  // namespace lstm_planner
