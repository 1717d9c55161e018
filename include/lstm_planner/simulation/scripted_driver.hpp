#pragma once

#include <cstdint>
#include <optional>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid/distance_field.hpp"
#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner {

/// How somebody drives with keys, and how well. Units: visitDriverParameters().
struct ScriptedDriverParameters {
  double speed = 0.3;
  double turn_speed = 1.5;
  double footprint_radius = 0.17425;
  double clearance = 0.1;
  double comfort = 0.4;
  double reluctance = 1.5;
  double lookahead = 0.6;
  double sharp_turn = 0.5;
  /// Whether a turn key is also pressed while driving, so that the robot drives arcs where the path bends less. Labels
  /// (thesis Eq. 4.1) hardly show arcs: in half a second the direction differs only by half of the arc's turn.
  bool drives_arcs = false;
  double shortest_reaction = 0.2;
  double longest_reaction = 0.3;
  double shortest_hold = 0.15;
  double wander = 0.06;
  double pause_interval = 60.0;
  double longest_pause = 2.0;
  double arrival_distance = 0.15;
};

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitDriverParameters(Parameters& driver, const Visitor& visit) {
  visit("speed", driver.speed, {0.01, 10.0}, "m/s", "while the forward key is held");
  visit("turn_speed", driver.turn_speed, {0.01, 20.0}, "rad/s", "while a turn key is held");
  visit("footprint_radius", driver.footprint_radius, {0.02, 5.0}, "m", "of the robot");
  visit("clearance", driver.clearance, {0.0, 5.0}, "m",
        "smallest distance that the path keeps between footprint and walls");
  visit("comfort", driver.comfort, {0.0, 10.0}, "m",
        "with a smaller distance to walls the path counts as longer than it is");
  visit("reluctance", driver.reluctance, {0.0, 100.0}, "", "how much longer: up to 1 + this times");
  visit("lookahead", driver.lookahead, {0.01, 20.0}, "m", "along the path to the point that the driver steers to");
  visit("sharp_turn", driver.sharp_turn, {0.2, 3.1416}, "rad", "before a larger turn the driver stops");
  visit("drives_arcs", driver.drives_arcs, {}, "",
        "the driver also presses turn keys while driving forward; labels hardly show arcs");
  visit("shortest_reaction", driver.shortest_reaction, {0.0, 0.5}, "s",
        "shortest time from seeing to pressing or releasing a key");
  visit("longest_reaction", driver.longest_reaction, {0.0, 0.5}, "s",
        "longest time from seeing to pressing or releasing a key");
  visit("shortest_hold", driver.shortest_hold, {0.0, 0.5}, "s", "shortest time that a key is held or released");
  visit("wander", driver.wander, {0.0, 0.5}, "rad", "standard deviation of the direction that the driver aims at");
  visit("pause_interval", driver.pause_interval, {0.0, 86400.0}, "s", "between pauses on average; 0: none");
  visit("longest_pause", driver.longest_pause, {0.0, 3600.0}, "s", "of a pause");
  visit("arrival_distance", driver.arrival_distance, {0.01, 10.0}, "m",
        "nearer to the goal than this, the driver has arrived");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const ScriptedDriverParameters& parameters);

/// Drives like a person who sees robot and building from above and has three keys: forward, left and right; if none is
/// held, the robot stops. The driver follows the shortest comfortable path to the goal, stops to turn, reacts late,
/// aims inexactly, pauses sometimes, and does not touch what is in the map (unknown cells count as walls). The same for
/// the same seed, poses and times.
///
/// Call command() 10 times a second or more often, or it brakes too late.
class ScriptedDriver {
 public:
  /// What the driver does.
  enum class State {
    kWaiting,  ///< there is no goal
    kDriving,  ///< the driver drives to the goal
    kArrived,  ///< the robot is at the goal, and the keys are released
    kNoPath    ///< there is no path from the robot to the goal, or the goal is too near to a wall
  };

  /// `world` must outlive the driver. Throws as validate().
  ScriptedDriver(const GridWorld& world, const ScriptedDriverParameters& parameters, std::uint64_t seed);

  void setGoal(const Point2& goal);  ///< world frame
  void dropGoal();

  /// The command of the keys that are held at that time (s, never less than before); `pose`: true pose, world frame.
  Twist2 command(const Pose2& pose, double time);

  State state() const { return state_; }

 private:
  /// Which keys are held.
  struct Keys {
    bool forward = false;
    int turn = 0;  ///< 1: left, -1: right
    bool operator==(const Keys& other) const { return forward == other.forward && turn == other.turn; }
  };

  CellIndex startOfPath(const Point2& position) const;
  Point2 pointAhead(const Point2& position) const;
  bool isOpen(const Point2& from, const Point2& to) const;
  Twist2 twistOf(const Keys& keys) const;
  bool isSafe(const Pose2& pose, const Keys& keys) const;
  void reconsider(const Pose2& pose, double time);
  Keys decide(const Pose2& pose);
  Keys steer(const Pose2& pose, double error);
  bool pauses(double time);
  void wander(double seconds);

  const GridWorld& world_;
  ScriptedDriverParameters parameters_;
  DistanceField distances_;
  Random random_;
  State state_ = State::kWaiting;
  Point2 goal_;
  std::optional<GeodesicField> field_;

  Keys keys_;                    ///< held
  std::optional<Keys> decided_;  ///< will be held from `change_` on
  double change_ = 0.0;          ///< s
  double next_look_ = 0.0;       ///< s
  double last_look_ = 0.0;       ///< s
  double pause_end_ = 0.0;       ///< s
  double aim_error_ = 0.0;       ///< rad
  bool turning_ = false;         ///< in place
  bool is_aimed_ = false;        ///< at the path ahead, so that little room is needed
};

}  // namespace lstm_planner
