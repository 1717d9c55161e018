#include "lstm_planner/practice/teacher.hpp"

#include <cmath>
#include <limits>

namespace lstm_planner {

namespace {

GeodesicField makeField(const GridWorld& world, const Point2& goal) {
  constexpr double kLeastClearance = 0.1;  // m between the footprint and walls
  constexpr double kComfort = 0.5;         // m; nearer to walls than this the path costs more
  constexpr double kReluctance = 1.5;      // how much more: see GeodesicField
  GeodesicField::Options options;
  options.clearance = kPracticeRadius + kLeastClearance;
  options.comfort = kPracticeRadius + kComfort;
  options.reluctance = kReluctance;
  return GeodesicField(world.grid(), world.distances(), world.grid().cellAt(goal), options);
}

}  // namespace

Teacher::Teacher(const GridWorld& world, const Point2& goal) : world_(world), field_(makeField(world, goal)) {}

CellIndex Teacher::startOfPath(const Point2& position) const {
  const CellIndex here = world_.grid().cellAt(position);
  if (std::isfinite(field_.at(here))) {
    return here;
  }
  // The robot stands closer to a wall than the teacher would: take the nearest cell from which there is a path.
  const int reach = static_cast<int>(0.4 / world_.grid().resolution());
  CellIndex best = here;
  double best_distance = std::numeric_limits<double>::infinity();
  for (int row = here.row - reach; row <= here.row + reach; ++row) {
    for (int column = here.column - reach; column <= here.column + reach; ++column) {
      const double distance = std::hypot(column - here.column, row - here.row);
      if (distance < best_distance && std::isfinite(field_.at({column, row}))) {
        best = {column, row};
        best_distance = distance;
      }
    }
  }
  return best;
}

bool Teacher::direction(const Point2& position, double* direction) const {
  constexpr double kLookahead = 0.5;  // m along the path to the point that is steered for; about one step
  CellIndex cell = startOfPath(position);
  if (!std::isfinite(field_.at(cell))) {
    return false;
  }
  while (distanceBetween(position, world_.grid().centerOf(cell)) < kLookahead) {
    const CellIndex next = field_.nextOnPath(cell);
    if (next == cell) break;  // the goal's own cell
    cell = next;
  }
  *direction = directionTo(position, world_.grid().centerOf(cell));
  return true;
}

double Teacher::distanceToGo(const Point2& position) const { return field_.at(startOfPath(position)); }

}  // namespace lstm_planner
