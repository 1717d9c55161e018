#pragma once

#include <cstdint>

#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// A random office building: a rectangle that is divided recursively by corridors and into rooms. Every room has a door
/// to a corridor if one is beside it, otherwise to a neighbour. Boxes stand along the walls and in the middle, and
/// there are round pillars. Units: visitFloorPlanParameters().
struct FloorPlanParameters {
  double width = 20.0;
  double height = 14.0;
  double resolution = 0.05;
  double wall_thickness = 0.15;
  double smallest_room = 3.0;
  double door_width = 0.9;
  double extra_doors = 0.3;
  double furniture = 0.06;
  double smallest_gap = 0.7;
  int tries = 60;
};

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitFloorPlanParameters(Parameters& plan, const Visitor& visit) {
  visit("resolution", plan.resolution, {0.01, 0.2}, "m", "of a cell");
  visit("wall_thickness", plan.wall_thickness, {0.01, 1.0}, "m", "of walls");
  visit("door_width", plan.door_width, {0.6, 3.0}, "m", "of doors");
  visit("smallest_room", plan.smallest_room, {1.2, 50.0}, "m", "shortest side of a room");
  visit("width", plan.width, {1.2, 500.0}, "m", "of the building");
  visit("height", plan.height, {1.2, 500.0}, "m", "of the building");
  visit("extra_doors", plan.extra_doors, {0.0, 1.0}, "", "probability of an additional door in a wall");
  visit("furniture", plan.furniture, {0.0, 0.5}, "", "share of the floor that is covered by boxes and round things");
  visit("smallest_gap", plan.smallest_gap, {0.0, 5.0}, "m",
        "free space around furniture, except towards a wall that it touches");
  visit("tries", plan.tries, {1, 100000}, "", "places for furniture that are tried for each room");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const FloorPlanParameters& parameters);

/// The same plan for the same seed on every machine, its lower left corner at (0, 0). A robot 0.35 m wide can reach
/// every place in which it fits; the outer wall is closed. Throws as validate().
OccupancyGrid generateFloorPlan(const FloorPlanParameters& parameters, std::uint64_t seed);

}  // namespace lstm_planner
