#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid/map_generators.hpp"
#include "lstm_planner/simulation/generated_world.hpp"
#include "simulation/building.hpp"

namespace lstm_planner {
namespace {

/// Takes walls out that have a corridor on both sides.
void openLoops(double probability, Random& random, PassableGrid* maze) {
  for (int row = 1; row + 1 < maze->rows(); ++row) {
    // Walls between corridors have one odd number and one even one; two even ones are the posts.
    for (int column = 1 + row % 2; column + 1 < maze->columns(); column += 2) {
      const CellIndex wall{column, row};
      if (!maze->passable(wall) && uniform(random) < probability) maze->set(wall, true);
    }
  }
}

/// Draws a maze of single cells with its own widths of walls (even cells) and corridors (odd cells).
OccupancyGrid enlarge(const PassableGrid& maze, int wall, int corridor, double resolution) {
  std::vector<int> columns;
  for (int i = 0; i < maze.columns(); ++i)
    columns.insert(columns.end(), static_cast<std::size_t>(i % 2 ? corridor : wall), i);
  std::vector<int> rows;
  for (int i = 0; i < maze.rows(); ++i) rows.insert(rows.end(), static_cast<std::size_t>(i % 2 ? corridor : wall), i);
  OccupancyGrid grid(static_cast<int>(columns.size()), static_cast<int>(rows.size()), resolution);
  for (const CellIndex cell : grid.cells()) {
    const CellIndex from{columns[static_cast<std::size_t>(cell.column)], rows[static_cast<std::size_t>(cell.row)]};
    if (!maze.passable(from)) grid.set(cell, Cell::kOccupied);
  }
  return grid;
}

}  // namespace

OccupancyGrid generateMazeWorld(const MazeWorldParameters& parameters, std::uint64_t seed) {
  MazeParameters cells;
  cells.columns = 2 * parameters.columns + 1;
  cells.rows = 2 * parameters.rows + 1;
  cells.corridor_width = 1;
  cells.branching = parameters.branching;
  PassableGrid maze = generateMaze(cells, seed);
  Random random(~seed);
  openLoops(parameters.loops, random, &maze);
  return enlarge(maze, toCells(parameters.wall_thickness, parameters.resolution),
                 toCells(parameters.corridor_width, parameters.resolution), parameters.resolution);
}

OccupancyGrid generateRoomsWorld(const RoomsWorldParameters& parameters, std::uint64_t seed) {
  RoomParameters cells;
  cells.room_size = toCells(parameters.room_size, parameters.resolution);
  cells.door_cells = toCells(parameters.door_width, parameters.resolution);
  cells.extra_doors = parameters.extra_doors;
  cells.columns = parameters.columns * (cells.room_size + 1) + 1;
  cells.rows = parameters.rows * (cells.room_size + 1) + 1;
  const PassableGrid rooms = generateRooms(cells, seed);
  OccupancyGrid grid(rooms.columns(), rooms.rows(), parameters.resolution);
  for (const CellIndex cell : grid.cells()) {
    const bool edge = cell.column + 1 == grid.columns() || cell.row + 1 == grid.rows();
    if (edge || !rooms.passable(cell)) grid.set(cell, Cell::kOccupied);
  }
  return grid;
}

}  // namespace lstm_planner
