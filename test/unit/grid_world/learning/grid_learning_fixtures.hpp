#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "lstm_planner/grid/map_generators.hpp"
#include "lstm_planner/grid_world/learning/grid_course.hpp"

namespace lstm_planner {

inline PassableGrid smallCave(std::uint64_t seed) {
  CaveParameters parameters;
  parameters.columns = 32;
  parameters.rows = 32;
  parameters.share = 0.4;
  return generateCaves(parameters, seed);
}

inline CourseGoal goalOn(const PassableGrid& grid, CellIndex goal) {
  auto map = std::make_shared<CourseMap>();
  map->grid = grid;
  map->ranges = RangeTable(grid);
  return {map, goal, GridDistances(grid, goal, CornerCutting::kForbidden), {}};
}

/// Paths of 4 to 30 cells.
inline GridCourseParameters smallCourse() {
  GridCourseParameters parameters;
  parameters.min_length = 4.0;
  parameters.max_length = 30.0;
  parameters.goals = 20;
  return parameters;
}

}  // namespace lstm_planner
