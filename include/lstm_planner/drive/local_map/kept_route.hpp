#pragma once

#include "lstm_planner/drive/local_map/local_map.hpp"
#include "lstm_planner/drive/local_map/route_finder.hpp"

namespace lstm_planner {

/// The route that the robot follows, from where it is now.
class KeptRoute {
 public:
  /// Reserves the memory that most routes need.
  KeptRoute();

  const Route& route() const { return route_; }
  bool isEmpty() const { return route_.points.size() < 2; }

  void clear() { route_.points.clear(); }
  /// Exchanges it for another one.
  void swap(Route* route);
  void moveEnd(const Point2& end);

  /// The robot is there now: what it has driven, and corners that it can cut, are left away.
  void advance(const LocalMap& memory, const Point2& here);

 private:
  Route route_;
};

}  // namespace lstm_planner
