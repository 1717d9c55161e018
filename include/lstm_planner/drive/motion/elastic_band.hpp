#pragma once

#include <cstddef>
#include <vector>

#include "lstm_planner/drive/decision/decision.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/drive/local_map/local_map.hpp"

namespace lstm_planner {

/// Bends the start of a path away from the remembered obstacles (S. Quinlan and O. Khatib, "Elastic bands: connecting
/// path planning and control", 1993): a chain of points along the path. Each point is pulled to the middle between its
/// neighbours, and pushed away from the nearest obstacle on each side. The shortest path touches corners and door
/// posts; the bent one goes round a corner in an arc, and through the middle of a door. For controllers that cut
/// corners.
class ElasticBand {
 public:
  /// The decision of an agent with its path bent, so that the footprint keeps the distance `clearance` (m) if there is
  /// room; valid until the next call. Of a decision for one step only the path behind the waypoint is bent. It is
  /// returned unchanged if it neither follows the remembered path nor leads to a goal in sight, if the bent path would
  /// not be passable, or if the clearance is 0.
  const Decision& bend(const NavigationAgent& agent, const Pose2& robot, const Decision& decision, double clearance);

 private:
  void layChain(const Point2& robot, const Decision& decision);
  void addPiece(const Point2& corner);
  double relax(const LocalMap& memory);
  Point2 push(const LocalMap& memory, std::size_t i) const;
  bool isPassable(const LocalMap& memory) const;

  double distance_ = 0.0;      ///< m from the middle of the footprint to obstacles that is wanted
  double left_ = 0.0;          ///< m of the path for which there is no chain yet
  std::size_t first_ = 1;      ///< point of the chain that may move
  std::vector<Point2> chain_;  ///< from the robot on
  std::vector<Point2> rest_;   ///< corners of the path behind the chain
  Decision bent_;
};

}  // namespace lstm_planner
