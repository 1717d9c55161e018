#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "lstm_planner/drive/collision/shield_parameters.hpp"
#include "lstm_planner/drive/local_map/full_turn.hpp"
#include "lstm_planner/drive/local_map/local_map.hpp"
#include "lstm_planner/drive/local_map/memory_parameters.hpp"
#include "lstm_planner/drive/local_map/route_finder.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// Keeps the path to the goal through what is remembered, and finds out when there is none.
///
/// Remembered obstacles can be wrong (the odometry drifts, people go away). So when they enclose the goal, everything
/// is forgotten and the robot looks around again; then narrower places are tried. The goal counts as enclosed only if
/// this finds no path several times in a row, at the same place.
///
/// It searches at every step. It keeps its path as long as the new one is hardly better: otherwise every new wall would
/// make the robot turn back and forth between two paths of about the same length. All costs are in m.
class Replanner {
 public:
  enum class Answer {
    kRoute,       ///< follow route()
    kLookAround,  ///< turn on the spot, so that everything around is seen
    kNoPath,      ///< no path leads to the goal from here
    kLost         ///< what is remembered was wrong too often: the goal must be found by other means
  };

  Replanner(const MemoryParameters& parameters, const ShieldParameters& shield);

  /// A new goal; what is remembered of the obstacles stays. What was only taken as blocked is free again.
  void start();

  /// The same goal lies a little elsewhere: a route that ended at it ends at it still.
  void moveGoal(const Point2& from, const Point2& to);

  /// LocalMap::know()
  void know(std::vector<Point2> obstacles) { memory_.know(std::move(obstacles)); }

  /// The robot is nearer to the goal than ever. Clearances are whole again. How often the memory was wrong is forgiven
  /// only if it is nearer by a metre than where that was forgiven last: on the way around a closed obstacle with the
  /// goal in it, the robot comes a little nearer again and again.
  void noteProgress(const Point2& here, const Point2& goal);

  /// Takes in the situation and searches a path; one that is hardly better than the last one is not taken. `tolerance`:
  /// how near (m) to a goal in or behind an obstacle the route may end.
  Answer update(const Situation& situation, const Point2& goal, double tolerance);

  /// What it costs to go straight to `next` first, m: how much longer that and the shortest path from there are than
  /// the shortest path from `here`, never below 0; +inf where no path leads on from there. To be asked when update()
  /// has found a route, which stays the same. `path_on`: the corners of the path behind `next`.
  double regretOf(const Point2& here, const Point2& next, std::vector<Point2>* path_on);

  /// The start of the route turned out to be blocked although the memory does not know why. Returns the place that
  /// counts as blocked from now on; none where there is no route.
  std::optional<Point2> blockAhead();
  /// The same for the straight way from `here` to `next`.
  Point2 blockTowards(const Point2& here, const Point2& next);
  /// It was not.
  void unblock(const Point2& place) { memory_.unblock(place); }

  /// As update() found it, until it finds none: from the robot to the goal, or to where the footprint still fits when
  /// the goal lies in something.
  const Route& route() const { return route_; }

  /// What is remembered.
  const LocalMap& memory() const { return memory_; }

  /// The point that lies that far (m) along the route, of which there must be one.
  Point2 pointAhead(double distance) const;

  /// Where it lies as seen from `pose`, rad, counter-clockwise from straight ahead.
  double bearingAhead(const Pose2& pose, double distance) const;

  /// The corners of the route farther along than `distance` (m).
  void pointsAhead(double distance, std::vector<Point2>* points) const;

  /// Whether the goal is near (at least `near` m count as that), but the route to it is long: odometry may have moved
  /// the goal behind a wall.
  bool isGoalBehindObstacle(const Point2& here, const Point2& goal, double near) const;

  /// Where the route ends, of which there must be one.
  const Point2& end() const { return route_.points.back(); }

  /// Whether the footprint fits through on the straight path from one place to the other, as far as is remembered.
  bool isPassable(const Point2& from, const Point2& to) { return memory_.isFree(from, to, LocalMap::Passage::kTight); }

  /// Everything is forgotten, e.g. because the odometry jumped.
  void forget();

 private:
  bool hasRoute() const { return route_.points.size() > 1; }
  void advanceRoute(const Point2& here);
  bool isWorthKeeping() const;
  double costOf(const Route& route) const;
  Answer lookAround(const Situation& situation);
  void relaxClearance(bool relaxed);

  LocalMap memory_;
  RouteFinder finder_;
  double blocked_ahead_;  ///< m
  Route route_;
  Route found_;
  double shortest_ = 0.0;              ///< m, of the shortest path that the last update() knew
  double tolerance_ = 0.0;             ///< of the last update()
  bool looking_ = false;               ///< turning, after everything was forgotten
  FullTurn turn_;                      ///< while looking
  bool clearance_is_relaxed_ = false;  ///< no path was found otherwise
  int closed_in_a_row_ = 0;
  int forgotten_ = 0;                  ///< times that the memory was wrong and that are not forgiven
  std::optional<Point2> forgiven_at_;  ///< where the robot was then; empty before the first time
};

}  // namespace lstm_planner
