#pragma once

#include <cstdint>

#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

// Maps like those of the grid benchmark (N. Sturtevant, "Benchmarks for Grid-Based Pathfinding", 2012), so that
// training and evaluation need no download. The same parameters and seed give the same map on every machine. Sizes are
// in cells. The passable cells are connected without corner cutting, unless said otherwise. Every validate() throws
// std::invalid_argument naming the parameter, its value and what was expected; the generators call it.

/// A perfect maze: there is exactly one path between any two corridors. As in the benchmark, walls are one cell thick,
/// the first row and column are wall, and the last corridors are cut at the edge of the map.
struct MazeParameters {
  int columns = 512;
  int rows = 512;
  int corridor_width = 8;
  /// Probability that the maze is continued at a random place instead of the newest one. 0 gives long winding paths, 1
  /// short ones with many dead ends. 0.1 gives 17 % dead ends; the benchmark's mazes have 16 to 19 %.
  double branching = 0.1;
};
void validate(const MazeParameters& parameters);
PassableGrid generateMaze(const MazeParameters& parameters, std::uint64_t seed);

/// Single blocked cells at random places, exactly floor(share * cells) of them.
struct RandomFillParameters {
  int columns = 512;
  int rows = 512;
  double share = 0.25;
  /// Also blocks all cells that are not connected to the largest region, as the benchmark does with trees.
  bool fill_pockets = true;
};
void validate(const RandomFillParameters& parameters);
PassableGrid generateRandomFill(const RandomFillParameters& parameters, std::uint64_t seed);

/// Square rooms in rows and columns, with walls one cell thick and doors at random places. The first row and column are
/// wall; the last rooms are cut at the edge of the map.
struct RoomParameters {
  int columns = 512;
  int rows = 512;
  int room_size = 16;
  int door_cells = 1;        ///< width of a door
  double extra_doors = 0.5;  ///< probability of a door that is not needed to connect all rooms
};
void validate(const RoomParameters& parameters);
PassableGrid generateRooms(const RoomParameters& parameters, std::uint64_t seed);

/// Caves made by a cellular automaton: random cells are blocked; then, in each round, every cell takes the state of the
/// majority of the nine cells around it (cells outside are blocked). At the end all caves but the largest one are
/// filled.
struct CaveParameters {
  int columns = 512;
  int rows = 512;
  /// Share of blocked cells before the rounds. In 512 x 512 cells, 0.4 leaves 85 % passable and 0.45 69 %. At 0.5 there
  /// are many small caves, and the largest one is a quarter of the map.
  double share = 0.45;
  int rounds = 4;
};
void validate(const CaveParameters& parameters);
/// Throws std::runtime_error if ten draws leave no passable cell, as in small maps with a large share.
PassableGrid generateCaves(const CaveParameters& parameters, std::uint64_t seed);

}  // namespace lstm_planner
