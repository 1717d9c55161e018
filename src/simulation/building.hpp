#pragma once

#include <opencv2/core.hpp>
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

/// A length in whole cells, one at least; `resolution`: m a cell.
int toCells(double metres, double resolution);

/// Sets all cells of a box.
void fillBox(const CellBox& box, Cell cell, OccupancyGrid* grid);

/// Numbers the areas of the floor (from 1; 0 = it does not fit) in which a disc of that radius (m) can go about: a row
/// a row of the grid. Returns how many there are.
int labelOpenAreas(const OccupancyGrid& grid, double radius, cv::Mat1i* labels);

/// Puts furniture into the rooms, not into corridors nor before doors.
void furnish(const FloorPlanParameters& parameters, Random& random, Building* building);

}  // namespace lstm_planner
