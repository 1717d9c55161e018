#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/agent/obstacle_memory.hpp"

namespace lstm_planner {

/// A way to the goal through what is remembered; what was never seen counts as free.
struct Route {
  std::vector<Point2> points;  ///< odometry frame, from the start to the goal; straight between them
  double length = 0.0;         ///< m
  double cost = 0.0;           ///< m, tight places counted several times
};

/// Length of a way that is straight between its points, m.
double lengthOf(const std::vector<Point2>& points);

/// Finds the shortest way through an ObstacleMemory: A* on its cells, tight ones costing more, corners pulled straight
/// near the start. Beyond the window the way is taken as straight. The memory needed is allocated once.
class RouteFinder {
 public:
  /// `tightness`: how many times its length a way through a tight place costs, at least 1; through a narrow one, a
  /// quarter of what is above 1.
  explicit RouteFinder(double tightness);

  /// False when there is no way: obstacles that were seen enclose the start, or the goal, all around. A goal that lies in
  /// something is replaced by the nearest place that the footprint fits on, and one that cannot be reached, or only by a
  /// long detour from a start that is near it, by the first place on the way: at most `tolerance` (m) from the goal.
  bool find(ObstacleMemory& memory, const Point2& start, const Point2& goal, double tolerance, Route* route);

  /// Cost of a route under what is remembered now, m; +inf when it is blocked. Looks at its first `distance` m.
  double costOf(ObstacleMemory& memory, const Route& route, double distance) const;

 private:
  struct Open {
    std::uint32_t estimate;
    std::uint32_t cell;
  };
  /// Ends at the cell of the goal, or at the first cell nearer to the goal than `tolerance`, or at the border of the
  /// window when the goal lies outside.
  bool search(ObstacleMemory& memory, int start, const Point2& goal, double tolerance, int* end);
  bool trace(ObstacleMemory& memory, const Point2& start, int end, const Point2& goal, Route* route);
  void pullStraight(ObstacleMemory& memory, Route* route) const;

  double narrowness() const { return 1.0 + 0.25 * (tightness_ - 1.0); }

  double tightness_;
  std::vector<std::uint16_t> costs_;  ///< tenths of a cell, from the start
  std::vector<std::uint8_t> from_;    ///< direction of the last step
  std::vector<Open> open_;
};

}  // namespace lstm_planner
