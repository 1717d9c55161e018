#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/drive/collision/shield_parameters.hpp"
#include "lstm_planner/drive/local_map/local_map.hpp"
#include "lstm_planner/drive/local_map/memory_parameters.hpp"
#include "lstm_planner/drive/local_map/route_finder.hpp"

namespace lstm_planner {

/// The route that the robot follows, and its cost with the obstacles that are remembered now. A piece of it is checked
/// again only if something has changed beside it since the last check.
class KeptRoute {
 public:
  KeptRoute(const MemoryParameters& parameters, const ShieldParameters& shield);

  /// How far from a place, m, a change in the memory may make a path through it better or worse.
  static double reachOfChanges(const MemoryParameters& parameters, const ShieldParameters& shield);

  const Route& route() const { return route_; }
  bool isEmpty() const { return route_.points.size() < 2; }

  void clear();
  /// Exchanges it for another one.
  void swap(Route* route);
  /// Exchanges it, and what is known of its costs, for another one's.
  void swap(KeptRoute* other);
  void moveEnd(const Point2& end);

  /// The robot is there now: what it has driven, and corners that it can cut, are left away.
  void advance(LocalMap& memory, const Point2& here);

  /// Something has changed in the memory.
  void note(const LocalMap& memory, const LocalMap::Change& change);
  /// Anything may have.
  void noteAll();

  /// As RouteFinder::costOf().
  double cost(LocalMap& memory, const RouteFinder& finder, double distance);

 private:
  /// From the point before to one of the route's.
  struct Piece {
    float rest;    ///< m, from here to the end
    float length;  ///< m
    float cost;    ///< m; NaN where it is not known
    bool marked;   ///< in beside_
  };
  void measure();
  static int sharesASide(const LocalMap& memory);
  void forgetMarks();
  void markCosted(const LocalMap& memory);
  void mark(const LocalMap& memory, const Point2& from, const Point2& to);

  double reach_;  ///< m, within which a change matters
  Route route_;
  std::vector<Piece> pieces_;          ///< one a point
  std::vector<std::uint64_t> beside_;  ///< a bit for every few cells of the window: near to a marked piece
  bool all_are_marked_ = true;         ///< whose cost is known
};

}  // namespace lstm_planner
