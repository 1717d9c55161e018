#pragma once

#include <vector>

#include "lstm_planner/drive/local_map/cost_to_go.hpp"
#include "lstm_planner/drive/local_map/local_map.hpp"

namespace lstm_planner {

/// A path to the goal through what is remembered; what was never seen counts as free.
struct Route {
  std::vector<Point2> points;  ///< odometry frame, from the start to the goal; straight between them
  double length = 0.0;         ///< m
  double cost = 0.0;           ///< m, from cell to cell, tight places counted several times
};

/// Length of a path that is straight between its points, m.
double lengthOf(const std::vector<Point2>& points);

/// Finds the shortest path through a LocalMap: A* on its cells, tight ones costing more, corners pulled straight
/// near the start. Beyond the window the path is taken as straight. The memory needed is allocated once.
class RouteFinder {
 public:
  /// `tightness`: how many times its length a path through a tight place costs, at least 1; through a narrow one, a
  /// quarter of what is above 1.
  explicit RouteFinder(double tightness);

  /// False if there is no path: remembered obstacles enclose the start or the goal. A goal in an obstacle is replaced
  /// by the nearest place where the footprint fits. A goal that cannot be reached, or only by a long detour although
  /// the start is near it, is replaced by the first place on the path that is at most `tolerance` (m) from the goal.
  bool find(LocalMap& memory, const Point2& start, const Point2& goal, double tolerance, Route* route);

  /// A route from another place to where the last one ends, or to another end of the same search if that is nearer. The
  /// memory must not have changed since. False if there is none.
  bool findFrom(LocalMap& memory, const Point2& start, Route* route);

  /// Whether the detour is so long that the route should stop short of the goal, see find().
  static bool isDetour(double distance, double length, double tolerance);

  /// Cost of a straight piece of a route under what is remembered now, m; +inf when it is blocked.
  double costOf(const LocalMap& memory, const Point2& from, const Point2& to) const;

 private:
  /// Where paths may end.
  enum class Ending {
    kAtCell,  ///< of the end point
    kNear,    ///< at most tolerance_ from it
    kBorder   ///< of the window, when the end point lies outside
  };
  bool search(LocalMap& memory, int start, const Point2& end, double tolerance);
  void addEnd(LocalMap& memory, int column, int row);
  bool isEnd(LocalMap& memory, int cell) const;
  void follow(LocalMap& memory, const Point2& start, Route* route) const;
  void pullStraight(LocalMap& memory, Route* route) const;
  static std::size_t farthestInSight(LocalMap& memory, const std::vector<Point2>& points, std::size_t at);

  double tightness_;
  CostToGo cost_to_go_;
  std::vector<CostToGo::End> ends_;
  Ending ending_ = Ending::kAtCell;
  Point2 end_;
  int end_column_ = 0;  ///< of the end's cell, which may lie outside
  int end_row_ = 0;
  double tolerance_ = 0.0;
};

}  // namespace lstm_planner
