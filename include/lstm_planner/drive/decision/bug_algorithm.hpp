#pragma once

#include "lstm_planner/drive/collision/shield.hpp"
#include "lstm_planner/drive/collision/shield_parameters.hpp"
#include "lstm_planner/drive/decision/escape_parameters.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// A straight path to go: direction in the odometry frame (rad) and length (m).
struct Heading {
  double direction = 0.0;
  double distance = 0.0;
};

/// Brings the robot nearer to the goal than it has ever been, with bounded memory, if there is a path.
///
/// Drives straight to the goal. If an obstacle is in the way, follows its boundary, with the wall on one side, and
/// leaves it where the open path leads nearer to the goal than the point where it met the boundary. Turns back after
/// 24, 48, 96 ... m (the doubling search), so that the path is longer than the shorter way by a constant factor at
/// most. After a full turn around the boundary it goes around once more, closer; then it reports no path (after
/// Lumelsky and Stepanov, "Path-planning strategies for a point mobile automaton", Algorithmica 1987; Kamon and Rivlin,
/// "Sensory-based motion planning with global proofs", 1997; Baeza-Yates et al., "Searching in the plane", 1993).
class BugAlgorithm {
 public:
  enum class Answer {
    kGo,          ///< `move` is the path to drive
    kLookAround,  ///< boxed in: `move` is where to turn
    kNoPath,      ///< it went all around: the goal cannot be reached from here
    kNearer       ///< it is done: the robot is nearer to the goal than ever
  };

  BugAlgorithm(const EscapeParameters& parameters, const ShieldParameters& shield);

  /// Starts from here.
  void start();

  /// The same goal has moved a little: the remembered distances to the goal change by as much as the distance from
  /// where the boundary was met.
  void moveGoal(const Point2& from, const Point2& to);

  /// The next step in the current situation; `shield` knows its obstacles. kNearer: no boundary is followed, and the
  /// goal is nearer than `target_distance` (m).
  Answer decide(const Situation& situation, const Shield& shield, const Point2& goal, double target_distance,
                Heading* move);

 private:
  double openTowardsGoal(const Situation& situation, const Shield& shield, const Point2& goal, double distance) const;
  double clearance() const;
  void followTight(const Pose2& pose, const Point2& goal);
  void meetBoundary(const Situation& situation, const Shield& shield, const Point2& goal);
  Heading follow(const Situation& situation, const Shield& shield);
  bool probe(const Situation& situation, const Shield& shield, double start, double clearance, Heading* move) const;
  void measureBoundary(const Pose2& pose);
  double turnOf(double direction) const;
  bool loopClosed(const Pose2& pose) const;

  EscapeParameters parameters_;
  double roomy_clearance_;  ///< m
  double tight_clearance_;  ///< m
  double sight_;            ///< m, that a straight path is known to be free
  bool following_ = false;
  int side_ = -1;                  ///< side of the wall: -1 right, +1 left
  double travel_direction_ = 0.0;  ///< rad, odometry frame: how the boundary was followed last
  Pose2 last_position_;            ///< where the last decision was made
  Point2 hit_position_;
  double leave_below_ = 0.0;          ///< m to the goal, where a boundary was met or left at the nearest
  bool tight_ = false;                ///< second time around, with the tight clearance
  int rounds_ = 0;                    ///< boundaries gone around twice
  double departure_direction_ = 0.0;  ///< rad, odometry frame: how the boundary runs where it was met
  double along_ = 0.0;   ///< m, signed path along the boundary from the hit; positive in the first direction
  double turned_ = 0.0;  ///< rad, how much the boundary has turned since the hit
  int sense_ = 1;        ///< +1 while following in the first direction, -1 after turning back
  double leg_ = 0.0;     ///< m of boundary on this side of the hit before turning back
};

}  // namespace lstm_planner
