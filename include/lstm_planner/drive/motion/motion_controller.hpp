#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/collision/shield.hpp"
#include "lstm_planner/drive/perception/moving_returns.hpp"
#include "lstm_planner/drive/perception/moving_things.hpp"

namespace lstm_planner {

/// Limits and habits of the controller; the defaults suit the Create 2. What each means: visitMotionParameters().
struct MotionParameters {
  double max_linear = 0.3;
  double max_angular = 2.0;
  double max_wheel_speed = 0.5;
  double axle_length = 0.235;
  double linear_acceleration = 0.6;
  double wheel_acceleration = 0.0;
  double lookahead = 0.35;
  double nearest_target = 0.06;
  double turn_in_place = 1.2;
  double heading_gain = 2.5;
  double reaction_time = 0.25;
  double safety_margin = 0.03;
  double patience = 15.0;
  double slow_gap = 0.15;
  double slow_speed = 0.15;
  MovingReturnsParameters moving;  ///< how people are found
  double person_speed = 1.0;
  double person_margin = 0.15;
  double person_slow_speed = 0.08;
  double evade_time = 0.0;
  double evade_margin = 0.6;
  double position_tolerance = 0.2;
  double heading_tolerance = 3.15;
};

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitMotionParameters(Parameters& motion, const Visitor& visit) {
  visit("max_linear", motion.max_linear, {0.01, 10.0}, "m/s",
        "largest forward speed (a Create 2 really reaches 0.33); a slower robot stops in less space");
  visit("max_angular", motion.max_angular, {0.01, 20.0}, "rad/s", "largest turning speed");
  visit("max_wheel_speed", motion.max_wheel_speed, {0.01, 20.0}, "m/s",
        "largest speed of a wheel; commands stay below it, because a base that limits each wheel by itself bends the "
        "path");
  visit("axle_length", motion.axle_length, {0.01, 5.0}, "m", "wheel separation (track width)");
  visit("linear_acceleration", motion.linear_acceleration, {0.01, 50.0}, "m/s^2",
        "acceleration and deceleration; not more than the deceleration that the robot reaches");
  visit(
      "wheel_acceleration", motion.wheel_acceleration, {0.0, 50.0}, "m/s^2",
      "acceleration of a wheel; the slower the wheels are, the sooner the robot brakes before it turns near something; "
      "0: as linear_acceleration");
  visit("lookahead", motion.lookahead, {0.01, 20.0}, "m",
        "distance along the plan to the point that the robot steers to; longer is smoother and cuts corners");
  visit("nearest_target", motion.nearest_target, {0.001, 5.0}, "m",
        "the robot does not steer to points of the plan that are nearer than this");
  visit("turn_in_place", motion.turn_in_place, {0.01, 4.0}, "rad",
        "with a larger heading error the robot turns in place; smaller follows the plan more exactly and stops more "
        "often");
  visit("heading_gain", motion.heading_gain, {0.01, 100.0}, "rad/s",
        "turning speed for each rad of heading error; larger turns faster and overshoots with a slow odometry");
  visit("reaction_time", motion.reaction_time, {0.001, 10.0}, "s",
        "time from a measurement of the odometry to the motion of the wheels, with the driver's loop; longer stops "
        "earlier");
  visit("safety_margin", motion.safety_margin, {0.001, 5.0}, "m",
        "distance kept between the footprint and every return; at least three times the noise of the scanner");
  visit(
      "patience", motion.patience, {0.0, 3600.0}, "s",
      "time for which the robot may stand before an obstacle, with no person near; after half of it a robot with "
      "corners creeps out with two thirds of the safety_margin, on a way that it plans to where it can turn, and after "
      "all of it the controller says no, so that move_base recovers or aborts; about move_base's "
      "controller_patience; 0: it waits for ever");
  visit("slow_gap", motion.slow_gap, {0.001, 20.0}, "m",
        "the robot slows down if its path leads nearer to an obstacle than this; larger is slower");
  visit("slow_speed", motion.slow_speed, {0.001, 10.0}, "m/s",
        "speed towards an obstacle that the robot nearly touches; max_linear: it never slows down");
  visitMovingParameters(motion.moving, visit);
  visit("person_speed", motion.person_speed, {0.01, 20.0}, "m/s",
        "speed at which something that moves may come towards the robot; faster stops earlier and waits longer");
  visit("person_margin", motion.person_margin, {0.001, 10.0}, "m",
        "distance between something that moves and the footprint: the robot stands before the thing is nearer");
  visit("person_slow_speed", motion.person_slow_speed, {0.0, 10.0}, "m/s",
        "largest speed beside a person who walked and now stands; larger passes sooner; 0: the robot waits until "
        "moving/remember has passed");
  visit("evade_time", motion.evade_time, {0.0, 10.0}, "s",
        "time for which the motion of things is predicted: the robot gets out of the way of things that would come too "
        "near; larger does so sooner; 0: it stands and waits, which is right among people and for slow robots");
  visit("evade_margin", motion.evade_margin, {0.001, 10.0}, "m",
        "predicted distances below this are too near, see evade_time; larger gets out of the way sooner");
  visit("position_tolerance", motion.position_tolerance, {0.001, 10.0}, "m",
        "nearer to the goal than this the robot has arrived; not less than the planner's goal_tolerance");
  visit("heading_tolerance", motion.heading_tolerance, {0.001, 10.0}, "rad",
        "difference from the goal's heading; pi or more: every heading is accepted");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const MotionParameters& parameters);

/// Why the robot does not drive on.
enum class StopReason {
  kNone,         ///< it drives, or turns to where it will
  kArrived,      ///< at the end of the plan
  kNoPlan,       ///< waits for a plan
  kObstacle,     ///< something is within the margin of where it would drive
  kPerson,       ///< yields to what moves, or has moved
  kStuck,        ///< it has stood before an obstacle, or tried to move without success, for longer than the patience
  kIdle,         ///< it does not move, although it is told to
  kOldPlan,      ///< the plan is not renewed
  kUnusableData  ///< a pose, scan, odometry or transform is missing, too old, or makes no sense
};

/// A few words on it, such as "it yields to somebody who moves".
const char* toString(StopReason reason);

/// What the controller commands, and why it is not to drive: a robot that is stopped may still turn.
struct MotionCommand : Twist2 {
  StopReason stop = StopReason::kNone;
  bool goes_back = false;  ///< it retraces the path that it came
};

/// s; nobody asks for commands more often.
constexpr double kShortestPeriod = 0.001;

/// What a command is for.
struct MotionSituation {
  const std::vector<Pose2>& plan;  ///< in the frame of `pose`
  const Pose2 pose;                ///< the newest
  const Twist2 current;            ///< measured
  const Shield& shield;            ///< shows the latest scan as it lies from `pose`
  const double period;             ///< s, to the next command; kShortestPeriod or more
};

/// What was commanded before, and the path that a robot with corners came (Trail).
struct MotionHistory {
  std::optional<Pose2> back;           ///< the next pose back, or of a planned way out, base frame
  bool goes_back = false;              ///< the last command was to go back
  std::vector<Twist2> commanded = {};  ///< newest last, a period apart; they may not have reached the wheels
  bool has_stood = false;              ///< for so long that two thirds of the safety margin must do
  bool gets_out = false;               ///< `back` is of a planned way out, which it is to follow
  double short_by = 0.0;               ///< m/s that the base is to be told more (ShortfallWatch)

  /// Adds a command. Keeps those that may not have reached the wheels yet, which takes up to `time` s. `period`: as in
  /// MotionSituation.
  void note(const Twist2& command, double time, double period);
};

/// Turns and drives along a plan; never commands a motion which, braking included, comes nearer to a return than the
/// safety margin. It checks the real path: the current motion until the command acts, at once or after the reaction
/// time, then the commanded arc, braking to a stop. It also checks what the wheels make of that, since they take time:
/// while one brakes and the other one speeds up for a turn, the robot does not become slower, and a turn that goes on
/// while it starts to drive swings its corners.
///
/// A circle may always turn in place. A polygon turns where its corners have room; else it drives on along a wider arc,
/// or back along the path it came until it can turn.
///
/// Yields to what moves: if a thing came straight towards it at the speed of a person, it would stand before the thing
/// could reach the margin around it. It waits there, and goes on, slowly at first, when nothing moves near it. A fast
/// robot can also get out of the way (evade()).
class MotionController {
 public:
  /// Throws as validate().
  explicit MotionController(const MotionParameters& parameters);

  /// The next command. `moving` are points of things that move, base frame, `resting` of things that have moved and
  /// stand (MovingReturns). Zero for an empty plan, and for a pose, plan or period that cannot be used (kUnusableData).
  MotionCommand compute(const MotionSituation& situation, const std::vector<Point2>& moving = {},
                        const std::vector<Point2>& resting = {}, const MotionHistory& history = {}) const;

  /// That command, or one that gets out of the way of `things` (base frame) where they would come too near if they and
  /// the robot went on so. If there is no way out it does not drive towards a touch. It backs away, straight, only as
  /// far as `free_behind` (m): what the scan shows free there.
  MotionCommand evade(const MotionCommand& command, const MotionSituation& situation,
                      const std::vector<MovingThing>& things, double free_behind = 0.0,
                      const MotionHistory& history = {}) const;

  /// From now on it takes at least so long (s) from the pose that it is told to the wheels, and `before_persons` from
  /// the scan to the wheels: what moves has gone on since.
  void expectReactionTime(double least, double before_persons) {
    reaction_time_ = std::max(parameters_.reaction_time, least);
    reaction_before_persons_ = std::max(parameters_.reaction_time, before_persons);
  }
  double reactionTime() const { return reaction_time_; }  ///< s, from the pose to the motion of the wheels

  /// At the plan's last pose within the tolerances.
  bool goalReached(const Pose2& pose, const Pose2& goal) const;

  const MotionParameters& parameters() const { return parameters_; }

 private:
  struct Persons;
  struct Moment;
  /// How fast the robot may drive, and why not faster.
  struct SafeSpeed {
    double speed;  ///< m/s
    StopReason stop;
  };

  MotionCommand choose(const Moment& now, const std::vector<Point2>& moving) const;
  Pose2 target(const MotionSituation& situation) const;
  double wantedTurn(double error, double most) const;
  Twist2 withinWheelLimits(const Twist2& twist) const;
  SafeSpeed safeSpeed(const Twist2& wanted, const Moment& now) const;
  double cautiousSpeed(const Twist2& twist, const Shield& shield) const;
  double allowedSpeed(const Twist2& twist, const MotionSituation& situation) const;
  double yieldingSpeed(const Twist2& twist, const Shield& persons) const;
  double yieldingSpeed(const Twist2& twist, const Persons& persons) const;
  double yieldingReach(double footprint_radius) const;
  double stoppingDistance(double speed) const;
  Twist2 steadied(const Twist2& twist, const Moment& now) const;

  // Of a robot with corners.
  MotionCommand checked(const MotionCommand& command, const Moment& now) const;
  MotionCommand driveWithCorners(const Twist2& wanted, double error, const Moment& now) const;
  MotionCommand turnWithCorners(double error, const Moment& now) const;
  MotionCommand makeRoom(double error, const Moment& now) const;
  std::optional<MotionCommand> goBack(const Moment& now) const;
  Twist2 twistTo(const Pose2& place) const;
  double yieldingTurn(const Persons& persons) const;
  double turningSpeed(double angle, const Moment& now) const;
  SafeSpeed safeSpeedWithCorners(const Twist2& wanted, const Moment& now) const;

  MotionParameters parameters_;
  double reaction_time_;            ///< s, from the pose to the wheels
  double reaction_before_persons_;  ///< s, from the scan to the wheels
};

}  // namespace lstm_planner
