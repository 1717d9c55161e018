#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/moving_cylinders.hpp"
#include "lstm_planner/simulation/world.hpp"
#include "tools/drive_options.hpp"

namespace lstm_planner {

/// A task of a world, and the seed of what chance does in it.
struct NumberedDrive {
  std::string name;
  int number = 0;  ///< of the goal in a map or the room, of the world otherwise
  DriveTask task;
  std::uint64_t seed = 0;
};

/// A world and what is driven in it.
struct DriveWorld {
  std::string name;
  std::unique_ptr<World> world;
  const OccupancyGrid* map = nullptr;  ///< of `world`; nullptr where it consists of circles
  std::vector<Circle> circles;
  std::vector<Point2> walker_places;
  std::optional<MovingCylindersParameters> cylinders;  ///< that move in it
  std::vector<NumberedDrive> exercises;
};

/// All that is driven in one run of the tool.
struct DriveCourse {
  std::string source;  ///< what was asked for: the files, or the kind of worlds
  std::vector<DriveWorld> worlds;
  DriveParameters rules;
  bool is_barn = false;
  bool is_dynabarn = false;
  int left_out = 0;  ///< worlds, because the robot does not fit into them
};

DriveCourse makeDriveCourse(const DriveOptions& options);

}  // namespace lstm_planner
