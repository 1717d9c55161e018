#pragma once

#include <vector>

#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "lstm_planner/drive/motion/patience.hpp"
#include "lstm_planner/drive/motion/trail.hpp"
#include "lstm_planner/drive/perception/moving_surroundings.hpp"
#include "lstm_planner/drive/perception/seen_free.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// What follows a plan among people, in the robot and in simulation: sees by scan after scan what moves, and asks the
/// controller for a command. Gives up (StopReason::kStuck) where its Patience ends.
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
      history_.back = trail_.back(situation.pose, history_.goes_back);
    }
    const MotionSituation motion{plan, situation.pose, twist, shield, period};
    MotionCommand command = controller_.compute(motion, moving_.points(), moving_.resting(), history_);
    if (controller_.parameters().evade_time > 0.0) {
      const MotionParameters& limits = controller_.parameters();
      const double free_behind =
          seenFreeBehind(situation, shield.footprint(), limits.safety_margin, limits.max_linear * limits.evade_time);
      command = controller_.evade(command, motion, moving_.follow(situation), free_behind, history_);
    }
    const Patience::Left left = patience_.note(controller_.parameters().patience, command, plan, situation);
    if (left == Patience::Left::kNone) command = {{}, StopReason::kStuck};
    history_.has_stood = left != Patience::Left::kMuch;
    history_.goes_back = command.goes_back;
    const bool stands = command.linear == 0.0 && command.angular == 0.0;
    history_.backs_out = command.goes_back ? history_.backs_out || history_.has_stood : history_.backs_out && stands;
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
    patience_.clear();
    history_ = {};
  }

  /// At the plan's last pose within the tolerances.
  bool goalReached(const Pose2& pose, const Pose2& goal) const { return controller_.goalReached(pose, goal); }

 private:
  MotionController controller_;
  Trail trail_;
  MotionHistory history_;
  Patience patience_;
  MovingSurroundings moving_;
};

}  // namespace lstm_planner
