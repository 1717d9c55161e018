#pragma once

#include <cstdint>

#include "lstm_planner/base/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// A random office building: a rectangle cut recursively by corridors and into rooms, a door from every room to a
/// corridor where it has one beside it and to a neighbour otherwise, boxes along the walls and in the middle, round
/// pillars.
struct FloorPlanParameters {
  double width = 20.0;           ///< m
  double height = 14.0;          ///< m
  double resolution = 0.05;      ///< m a cell
  double wall_thickness = 0.15;  ///< m
  double smallest_room = 3.0;    ///< m, shortest side
  double door_width = 0.9;       ///< m
  double extra_doors = 0.3;      ///< probability of a second way through a wall
  double furniture = 0.06;       ///< share of the floor that is covered by boxes and round things
  double smallest_gap = 0.7;     ///< m kept free around furniture, but for the walls that it stands flush against
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const FloorPlanParameters& parameters);

/// The same plan for the same seed on every machine, its lower left corner at (0, 0). A robot of 0.35 m can reach every
/// place that it fits in; the outer wall is closed. Throws as validate().
OccupancyGrid generateFloorPlan(const FloorPlanParameters& parameters, std::uint64_t seed);

}  // namespace lstm_planner
