#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "lstm_planner/robot/driving/motion_controller.hpp"
#include "lstm_planner/robot/driving/stand_watch.hpp"
#include "lstm_planner/robot/driving/trail.hpp"
#include "lstm_planner/robot/perception/moving_surroundings.hpp"
#include "lstm_planner/robot/perception/seen_free.hpp"
#include "lstm_planner/robot/perception/situation.hpp"

namespace lstm_planner {

/// What follows a plan among people, in the robot and in simulation: sees by scan after scan what moves, and asks the
/// controller for a command. Gives up (StopReason::kStuck) where the robot has stood for longer than the patience,
/// until it is moved, has another goal, its plan leads another way, or three times the patience has passed.
class PathTracker {
 public:
  /// Throws as MotionController.
  explicit PathTracker(const MotionParameters& parameters) : controller_(parameters), moving_(parameters.moving) {
    moving_.expectSpeed(parameters.max_linear);
  }

  /// The next command along a plan in the odometry frame, `period` s before the one after it. `shield` shows the
  /// situation's obstacles, `twist` is the measured one. Zero for an empty plan.
  MotionCommand compute(const std::vector<Pose2>& plan, const Situation& situation, const Twist2& twist,
                        const Shield& shield, double period) {
    moving_.show(situation);
    if (!shield.footprint().isCircle()) {
      trail_.note(situation.pose, history_.goes_back);
      history_.back = trail_.back(situation.pose);
    }
    const MotionSituation motion{plan, situation.pose, twist, shield, period};
    MotionCommand command = controller_.compute(motion, moving_.points(), moving_.resting(), history_);
    if (controller_.parameters().evade_time > 0.0) {
      const MotionParameters& limits = controller_.parameters();
      const double free_behind =
          seenFreeBehind(situation, shield.footprint(), limits.safety_margin, limits.max_linear * limits.evade_time);
      command = controller_.evade(command, motion, moving_.follow(situation), free_behind, history_);
    }
    command = withPatience(command, plan, situation);
    history_.goes_back = command.goes_back;
    history_.note(command, controller_.reactionTime(), period);
    return command;
  }

  /// From the next command on; what moves is found as before. Throws as MotionController, and changes nothing.
  void change(const MotionParameters& parameters) {
    controller_ = MotionController(parameters);
    moving_.expectSpeed(parameters.max_linear);
  }

  /// What moves is seen every `scan_period` s and answered every `control_period` s; see MotionController.
  void expectReactionTime(double scan_period, double control_period) {
    constexpr double kDriverPeriod = 0.1;  // s, of the slowest usual base drivers
    controller_.expectReactionTime(scan_period + control_period + kDriverPeriod);
  }

  /// The odometry jumped: what was seen is somewhere else now.
  void forget() {
    moving_.reset();
    trail_.clear();
    stand_.clear();
    history_ = {};
  }

  /// At the plan's last pose within the tolerances.
  bool goalReached(const Pose2& pose, const Pose2& goal) const { return controller_.goalReached(pose, goal); }

 private:
  static constexpr double kGivesUpFor = 3.0;  ///< times the patience
  static constexpr double kWayAhead = 0.3;    ///< m along the plan to where it leads
  static constexpr double kAnotherWay = 1.0;  ///< rad
  static constexpr int kMostRetries = 4;      ///< until the robot gets away

  MotionCommand withPatience(const MotionCommand& command, const std::vector<Pose2>& plan, const Situation& situation) {
    const double patience = controller_.parameters().patience;
    if (plan.empty()) {
      stand_.clear();
      return command;
    }
    stand_.note(situation.pose, situation.time, {plan.back().x, plan.back().y},
                command.linear != 0.0 || command.angular != 0.0);
    const bool is_excused = command.stop == StopReason::kPerson || command.stop == StopReason::kArrived;
    if (is_excused) stand_.excuse(situation.time);
    history_.has_stood = patience > 0.0 && stand_.stood() > 0.5 * patience;
    const bool is_stuck = command.stop == StopReason::kObstacle ? stand_.stood() > patience : stand_.tried() > patience;
    if (patience == 0.0 || !is_stuck) {
      stuck_towards_.reset();
      return command;
    }
    // Whoever hears of it has given up by then, or expects another try.
    if (stand_.stood() > kGivesUpFor * patience) stand_.clear();
    if (leadsAnotherWay(plan, situation.pose) && stand_.retries() < kMostRetries) {
      stand_.retry();
      return command;
    }
    return {{}, StopReason::kStuck};
  }

  /// Than the plan did with which the robot gave up here.
  bool leadsAnotherWay(const std::vector<Pose2>& plan, const Pose2& pose) {
    const auto ahead =
        std::find_if(plan.begin(), plan.end(), [&](const Pose2& at) { return distanceBetween(pose, at) >= kWayAhead; });
    const double direction = directionTo(pose, ahead == plan.end() ? plan.back() : *ahead);
    if (!stuck_towards_) stuck_towards_ = direction;
    return std::abs(normalizeAngle(direction - *stuck_towards_)) > kAnotherWay;
  }

  MotionController controller_;
  Trail trail_;
  MotionHistory history_;
  StandWatch stand_;
  std::optional<double> stuck_towards_;  ///< rad, odometry frame
  MovingSurroundings moving_;
};

}  // namespace lstm_planner
