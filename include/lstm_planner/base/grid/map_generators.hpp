#pragma once

#include <cstdint>

#include "lstm_planner/base/grid/passable_grid.hpp"

namespace lstm_planner {

// Maps like those of the grid benchmark (N. Sturtevant, "Benchmarks for Grid-Based Pathfinding", 2012), so that
// learning and judging need no download. The same parameters and seed give the same map on every machine. Sizes are in
// cells. What is passable is always one region without corner cutting, unless said otherwise. Every validate() throws
// std::invalid_argument naming the parameter, its value and what was expected; the generators call it.

/// A perfect maze: one way only between any two corridors. As in the benchmark's, walls are one cell thick, the first
/// row and column are wall, and the last corridors are cut where the map ends.
struct MazeParameters {
  int columns = 512;
  int rows = 512;
  int corridor_width = 8;
  /// Probability that the maze grows on from a random place instead of the newest one: 0 gives long winding paths, 1
  /// short ones with many dead ends. 0.1 gives 17 % dead ends, where the benchmark's mazes have 16 to 19 %.
  double branching = 0.1;
};
void validate(const MazeParameters& parameters);
PassableGrid generateMaze(const MazeParameters& parameters, std::uint64_t seed);

/// Single blocked cells at random, exactly floor(share * cells) of them.
struct RandomFillParameters {
  int columns = 512;
  int rows = 512;
  double share = 0.25;
  /// Blocks what cannot be reached from the largest region too, as the benchmark does with trees.
  bool fill_pockets = true;
};
void validate(const RandomFillParameters& parameters);
PassableGrid generateRandomFill(const RandomFillParameters& parameters, std::uint64_t seed);

/// Square rooms in rows and columns with walls one cell thick, doors at random places of the walls. The first row and
/// column are wall; the last rooms are cut where the map ends.
struct RoomParameters {
  int columns = 512;
  int rows = 512;
  int room_size = 16;
  int door_cells = 1;        ///< width of a door
  double extra_doors = 0.5;  ///< probability of a door in a wall that needs none to connect all rooms
};
void validate(const RoomParameters& parameters);
PassableGrid generateRooms(const RoomParameters& parameters, std::uint64_t seed);

/// Caves by a cellular automaton: random fill, smoothed by rounds in which every cell takes the state of the majority
/// of the nine cells around it (outside is rock); then all but the largest cave is filled.
struct CaveParameters {
  int columns = 512;
  int rows = 512;
  /// Of rock before smoothing. In 512 x 512 cells 0.4 leaves 85 % open, 0.45 69 %; at 0.5 the caves fall apart, and the
  /// largest is a quarter of the map.
  double share = 0.45;
  int rounds = 4;
};
void validate(const CaveParameters& parameters);
/// Throws std::runtime_error when ten draws leave no cell open, which happens to small maps of much rock.
PassableGrid generateCaves(const CaveParameters& parameters, std::uint64_t seed);

}  // namespace lstm_planner
