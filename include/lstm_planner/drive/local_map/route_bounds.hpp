#pragma once

#include <cstdint>

#include "lstm_planner/drive/collision/shield_parameters.hpp"
#include "lstm_planner/drive/local_map/cost_to_go.hpp"
#include "lstm_planner/drive/local_map/local_map.hpp"
#include "lstm_planner/drive/local_map/memory_parameters.hpp"

namespace lstm_planner {

/// What any path to the goal costs at least, m, by the last search and what has changed since.
///
/// By the search's costs (CostToGo) no path from where the robot is now costs less than they say, because obstacles
/// that appear only make paths costlier; and where one has gone, a path that gained by it leads through there.
///
/// A search goes from cell to cell and counts fifths of one; a route is cheaper, as its corners are pulled straight. So
/// the ratio of the two is measured at every route found, and the bounds are scaled by it.
class RouteBounds {
 public:
  RouteBounds(const MemoryParameters& parameters, const ShieldParameters& shield);

  /// A search was made from `start` to `goal`: what changed before it no longer matters.
  void noteSearch(const LocalMap& memory, const Point2& start, const Point2& goal);

  /// The route from `here` that the search found costs so much, m (KeptRoute::cost()); +inf: it is blocked.
  void noteRoute(const LocalMap& memory, const CostToGo& costs, const Point2& here, double cost);

  /// Takes in the changes in the memory, and clears them there. Paths that cost `enough` (m) or more are not looked at
  /// closely; +inf: nor are those that cost as much as leastCost().
  void takeInChanges(LocalMap* memory, const CostToGo& costs, const Point2& here, const Point2& goal, double enough);

  /// Of any path from here to the goal, m.
  double leastCost(const LocalMap& memory, const CostToGo& costs, const Point2& here, const Point2& goal) const;

  /// Of a path through a place where an obstacle has gone since the search, m, before its corners are pulled straight:
  /// as Route::cost of a route that was just found.
  double throughFreed(const LocalMap& memory) const;

  /// Of the last search.
  const Point2& searchedGoal() const { return searched_goal_; }

 private:
  std::uint32_t leastFifths(const LocalMap& memory, const CostToGo& costs, const Point2& here,
                            const Point2& goal) const;

  double reach_;                     ///< m, within which a change matters
  double tightness_;                 ///< see RouteFinder
  double scale_ = 0.0;               ///< m of a route's cost in a fifth of a cell of the search's
  std::uint32_t through_freed_ = 0;  ///< fifths of a cell; least cost from freed_from_ through a place that was freed
  int freed_from_ = -1;              ///< cell
  Point2 searched_goal_;
};

}  // namespace lstm_planner
