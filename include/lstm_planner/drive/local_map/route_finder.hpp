#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/drive/local_map/cost_to_go.hpp"
#include "lstm_planner/drive/local_map/local_map.hpp"

namespace lstm_planner {

/// A path to the goal through what is remembered; what was never seen counts as free.
struct Route {
  std::vector<Point2> points;  ///< odometry frame, from the start to the goal; straight between them
  double length = 0.0;         ///< m
  double cost = 0.0;           ///< m, tight places counted several times
};

/// Length of a path that is straight between its points, m.
double lengthOf(const std::vector<Point2>& points);

/// Finds the shortest path through an LocalMap: A* on its cells, tight ones costing more, corners pulled straight
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

  /// A route from another place to the end of the last route that ended at the goal, without a new search; false if
  /// that search did not cover the place. If obstacles have gone since then, there may be a better route.
  bool fromLastSearch(LocalMap& memory, const Point2& start, Route* route);

  /// Whether the last route found ends at the goal, or at the place nearest to it: costToGo() is then what is left of
  /// the path there.
  bool endsAtGoal() const { return ends_at_goal_; }

  /// Of the last search that found a route.
  const CostToGo& costToGo() const { return cost_to_go_; }
  /// Whether the detour is so long that the route should stop short of the goal, see find().
  static bool isDetour(double distance, double length, double tolerance);

  /// Cost of a straight piece of a route under what is remembered now, m; +inf when it is blocked.
  double costOf(LocalMap& memory, const Point2& from, const Point2& to) const;

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
  bool ends_at_goal_ = false;
};

}  // namespace lstm_planner
