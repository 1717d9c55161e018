#pragma once

#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid/occupancy_grid.hpp"
#include "lstm_planner/simulation/floor_plan.hpp"

namespace lstm_planner {

/// Cells [left, right) x [bottom, top).
struct CellBox {
  int left = 0;
  int bottom = 0;
  int right = 0;
  int top = 0;

  int width() const { return right - left; }
  int height() const { return top - bottom; }
};

struct Room {
  CellBox box;
  bool is_corridor = false;
};

/// A building before its furniture.
struct Building {
  OccupancyGrid grid;
  std::vector<Room> rooms;
  std::vector<CellBox> doors;
};

/// A length in whole cells.
int toCells(double metres, const FloorPlanParameters& parameters);

/// Sets all cells of a box.
void fillBox(const CellBox& box, Cell cell, OccupancyGrid* grid);

Building buildRooms(const FloorPlanParameters& parameters, Random& random);

/// Puts furniture into the rooms, not into corridors nor before doors.
void furnish(const FloorPlanParameters& parameters, Random& random, Building* building);

}  // namespace lstm_planner
