#pragma once

#include <costmap_2d/costmap_2d.h>

#include <memory>

#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/world.hpp"
#include "recorded_steps.hpp"

namespace lstm_planner {

constexpr double kResolution = 0.05;  ///< m, of world and costmap

enum Goal { kNearGoal, kFarGoal };

/// A furnished office building as large as the costmap, the robot in its middle.
struct Course {
  int size = 0;  ///< cells a side
  Goal goal = kNearGoal;
  std::unique_ptr<GridWorld> world;
  std::unique_ptr<costmap_2d::Costmap2D> costmap;
  DriveTask task;
  RecordedDrive drive;
};

/// Always the same for a size (cells a side) and a goal. The last one is kept: benchmarks of one size and goal come one
/// after another.
const Course& course(int size, Goal goal);

}  // namespace lstm_planner
