#pragma once

#include "lstm_planner/drive/decision/action_set.hpp"
#include "lstm_planner/grid/distance_field.hpp"
#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner {

/// Radius of the robot that practises, a Create 2, m.
constexpr double kPracticeRadius = 0.17425;

/// A planner that knows the whole map: says which steering angle leads along the shortest comfortable path to the goal.
class Teacher {
 public:
  /// `world` must outlive the teacher; the goal is in the world frame.
  Teacher(const GridWorld& world, const Point2& goal);

  /// Direction (rad, world frame) of the path from a position (world frame); false if there is no path from there.
  bool direction(const Point2& position, double* direction) const;

  /// Length of the path to the goal, m, longer near walls (GeodesicField); +inf if there is none.
  double distanceToGo(const Point2& position) const;

 private:
  CellIndex startOfPath(const Point2& position) const;

  const GridWorld& world_;
  GeodesicField field_;
};

}  // namespace lstm_planner
