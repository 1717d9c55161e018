#include "unit/grid_world/agent/small_grids.hpp"

#include <algorithm>

#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner {
namespace {

using SmallGridRandom = std::mt19937;

/// Not std::uniform_int_distribution: its numbers differ between libraries.
int below(int limit, SmallGridRandom* random) {
  return static_cast<int>((*random)() % static_cast<std::uint32_t>(limit));
}

PassableGrid filledGrid(SmallGridRandom* random) {
  PassableGrid grid(3 + below(18, random), 3 + below(18, random), true);
  const int percent = 10 + below(41, random);
  for (const CellIndex cell : grid.cells()) {
    if (below(100, random) < percent) grid.set(cell, false);
  }
  return grid;
}

void carve(PassableGrid* grid, CellIndex from, CellIndex to, int width) {
  for (int row = std::min(from.row, to.row); row < std::max(from.row, to.row) + width; ++row) {
    for (int column = std::min(from.column, to.column); column < std::max(from.column, to.column) + width; ++column) {
      grid->set({column, row}, true);
    }
  }
}

/// A spanning tree of corridors by a random walk that backtracks; sometimes a few walls are taken out again.
PassableGrid mazeGrid(SmallGridRandom* random) {
  const int width = 1 + below(3, random);
  const int pitch = width + 1;
  const int columns = 2 + below(18 / pitch, random);
  const int rows = 2 + below(18 / pitch, random);
  PassableGrid grid(columns * pitch + 1, rows * pitch + 1, false);
  const auto place = [&](CellIndex room) { return CellIndex{1 + room.column * pitch, 1 + room.row * pitch}; };
  std::vector<CellIndex> rooms = {{0, 0}};
  carve(&grid, place(rooms[0]), place(rooms[0]), width);
  while (!rooms.empty()) {
    std::vector<CellIndex> fresh;
    for (int direction = 0; direction < kGridMoveCount; direction += 2) {
      const CellIndex room = cellBeside(rooms.back(), direction);
      const bool inside = room.column >= 0 && room.row >= 0 && room.column < columns && room.row < rows;
      if (inside && !grid.passable(place(room))) fresh.push_back(room);
    }
    if (fresh.empty()) {
      rooms.pop_back();
      continue;
    }
    const CellIndex room = fresh[static_cast<std::size_t>(below(static_cast<int>(fresh.size()), random))];
    carve(&grid, place(rooms.back()), place(room), width);
    rooms.push_back(room);
  }
  for (int opened = below(4, random); opened > 0; --opened) {
    grid.set({1 + below(grid.columns() - 2, random), 1 + below(grid.rows() - 2, random)}, true);
  }
  return grid;
}

CellIndex freeCell(const PassableGrid& grid, SmallGridRandom* random) {
  for (;;) {
    const CellIndex cell = {below(grid.columns(), random), below(grid.rows(), random)};
    if (grid.passable(cell)) return cell;
  }
}

}  // namespace

SmallGrid drawnGrid(const std::vector<std::string>& rows) {
  SmallGrid world;
  world.grid = PassableGrid(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), true);
  for (const CellIndex cell : world.grid.cells()) {
    const char letter = rows[static_cast<std::size_t>(cell.row)][static_cast<std::size_t>(cell.column)];
    if (letter == '#') world.grid.set(cell, false);
    if (letter == 'S') world.start = cell;
    if (letter == 'G') world.goal = cell;
  }
  return world;
}

SmallGrid pathOfBends() {
  constexpr int kColumns = 1601;
  PassableGrid grid(kColumns, 7, true);
  for (int column = 0; column < kColumns; ++column) {
    if (column + 1 < kColumns) grid.set({column, 1}, false);
    if (column % 2 == 0) continue;
    for (int row = 2; row < 7; ++row) grid.set({column, row}, row == (column % 4 == 1 ? 6 : 2));
  }
  return {grid, {0, 2}, {0, 0}};
}

SmallGrid smallGrid(std::uint32_t seed) {
  SmallGridRandom random(seed);
  SmallGrid world;
  world.grid = seed % 4 == 0 ? mazeGrid(&random) : filledGrid(&random);
  // Two places to stand on, however full the grid is.
  world.grid.set({0, 0}, true);
  world.grid.set({world.grid.columns() - 1, world.grid.rows() - 1}, true);
  world.start = freeCell(world.grid, &random);
  do {
    world.goal = freeCell(world.grid, &random);
  } while (world.goal == world.start);
  return world;
}

Walk walk(const SmallGrid& world, GridAgent* agent, CornerCutting corner_cutting, std::size_t most_steps) {
  Walk walk;
  CellIndex cell = world.start;
  agent->start(world.start, world.goal);
  while (cell != world.goal) {
    if (walk.steps == most_steps) return walk;
    agent->observe({cell, world.goal, senseRanges(world.grid, cell)});
    const int direction = agent->decide();
    if (direction == kNoPath) {
      walk.end = WalkEnd::kNoPath;
      return walk;
    }
    if (!movePossible(world.grid, cell, direction, corner_cutting)) {
      walk.end = WalkEnd::kCollided;
      return walk;
    }
    cell = cellBeside(cell, direction);
    agent->step(direction, true);
    ++walk.steps;
  }
  walk.end = WalkEnd::kArrived;
  return walk;
}

}  // namespace lstm_planner
