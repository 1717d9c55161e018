#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// The kinds of worlds that networks learn in and are judged in.
enum class WorldKind {
  kMaze,       ///< corridors 0.8 to 1.6 m wide, with or without loops
  kOffice,     ///< floor plans with furniture
  kCorridors,  ///< corridors of different widths with dead ends
  kForest,     ///< poles at random; in half of the forests all gaps are wide enough for the robot
  kOpen,       ///< nothing in sight
  kRooms,      ///< empty rooms with doors
  kFurnished   ///< floor plans full of furniture, 0.4 to 0.8 m apart
};

/// All of them.
const std::vector<WorldKind>& worldKinds();

/// "mazes", "offices", "corridors", "forest", "open", "rooms", "furnished".
const char* toString(WorldKind kind);
/// Throws std::invalid_argument with the possible names.
WorldKind worldKindOf(const std::string& name);

/// A world of that kind; its size and everything else is drawn from the seed, the same on every machine. It has places
/// that are 5 m or more of path apart for a disc of the Create 2's radius and 7 cm of clearance.
OccupancyGrid generateWorld(WorldKind kind, std::uint64_t seed);

/// What a world is for. A network must not be judged in a world in which it has learned.
enum class WorldUse { kTraining, kValidation, kJudging };

/// The seed of the `number`-th world that belongs to `seed`. The two highest bits are those of the use (00 training, 01
/// validation during training, 1x judging, which is what `lstm_planner drive` does), so that two uses never share a
/// world, with any seeds.
std::uint64_t worldSeed(WorldUse use, std::uint64_t seed, std::uint64_t number);

// The generators of these worlds, besides the floor plans of floor_plan.hpp. The same parameters and seed give the same
// world on every machine, its lower left corner at (0, 0), closed by a wall. Not all parameters are checked: sizes and
// radii must be above 0, and shares and probabilities in [0, 1].

/// A maze of corridors at right angles, perfect (exactly one path between any two places) or with loops.
struct MazeWorldParameters {
  int columns = 8;  ///< corridors side by side
  int rows = 8;
  double corridor_width = 1.2;   ///< m
  double wall_thickness = 0.15;  ///< m
  double branching = 0.1;        ///< as MazeParameters::branching
  double loops = 0.0;            ///< probability that a wall between two corridors is removed
  double resolution = 0.05;      ///< m a cell
};
OccupancyGrid generateMazeWorld(const MazeWorldParameters& parameters, std::uint64_t seed);

/// Rooms of one size in rows and columns, with doors at random places of the walls between them; all are connected.
struct RoomsWorldParameters {
  int columns = 4;  ///< rooms side by side
  int rows = 3;
  double room_size = 4.0;    ///< m
  double door_width = 1.0;   ///< m
  double extra_doors = 0.3;  ///< probability of a door in a wall that needs none to connect all rooms
  double resolution = 0.1;   ///< m a cell, and the thickness of the walls
};
OccupancyGrid generateRoomsWorld(const RoomsWorldParameters& parameters, std::uint64_t seed);

/// Corridors of different widths in solid ground. Each starts in an earlier one, at right angles to it: there are
/// bends, crossings, loops and many dead ends. If there is no room, there are fewer corridors, but they reach 5.5 m
/// along one side unless the parameters leave no room for that.
struct CorridorWorldParameters {
  double width = 18.0;   ///< m
  double height = 14.0;  ///< m
  int corridors = 12;
  double narrowest = 0.8;    ///< m
  double widest = 1.8;       ///< m
  double resolution = 0.05;  ///< m a cell
};
OccupancyGrid generateCorridorWorld(const CorridorWorldParameters& parameters, std::uint64_t seed);

/// A walled field of round poles. For a disc of radius `passage` there is a path from the left end of the field to the
/// right end: poles are removed until there is one.
struct ForestParameters {
  double width = 12.0;            ///< m
  double height = 10.0;           ///< m
  double density = 0.05;          ///< share of the floor under poles, before any are removed
  double smallest_radius = 0.05;  ///< m
  double largest_radius = 0.2;    ///< m
  double gap = 0.0;               ///< m, smallest gap between two poles; 0 = they may touch and overlap
  double passage = 0.25;          ///< m, radius of the disc that gets through: the footprint and a clearance
  double resolution = 0.05;       ///< m a cell
};
OccupancyGrid generateForest(const ForestParameters& parameters, std::uint64_t seed);

}  // namespace lstm_planner
