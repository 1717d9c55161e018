#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "lstm_planner/drive/motion/patience.hpp"
#include "lstm_planner/drive/motion/reaction_watch.hpp"
#include "lstm_planner/drive/motion/shortfall_watch.hpp"
#include "lstm_planner/drive/motion/trail.hpp"
#include "lstm_planner/drive/perception/moving_surroundings.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// What follows a plan among people, in the robot and in simulation: sees by scan after scan what moves, and asks the
/// controller for a command. A robot with corners that has stood for half of its Patience is led by a planned way out
/// (findWayOut). Gives up (StopReason::kStuck) where its Patience ends.
class PathTracker {
 public:
  /// Throws as MotionController.
  explicit PathTracker(const MotionParameters& parameters) : controller_(parameters), moving_(parameters.moving) {
    moving_.expectSpeed(parameters.max_linear);
  }

  /// The next command, as MotionController::compute(). `seen`: by the newest scan; `now`: where the robot has come
  /// since, in the same frame, `later` s after the scan. The shield of `now` shows what is seen as it lies from there.
  MotionCommand compute(const MotionSituation& now, const Situation& seen, double later = 0.0);

  /// From the next command on; what moves is found as before. Throws as MotionController, and changes nothing.
  void change(const MotionParameters& parameters) {
    controller_ = MotionController(parameters);
    moving_.expectSpeed(parameters.max_linear);
  }

  /// The pose is `pose_age` s old; the scan is `scan_age` s old, or at the most where its age is not known. The next
  /// command follows after `control_period` s. The base may take as long as it was seen to.
  void expectReactionTime(double pose_age, double scan_age, double control_period) {
    constexpr double kDriverPeriod = 0.1;  // s, of the slowest usual base drivers
    const double answered = control_period + std::max(kDriverPeriod, reaction_.delay());
    controller_.expectReactionTime(pose_age + answered, scan_age + answered);
  }
  /// Of the base, s; 0 as long as it is not seen to be longer than expected.
  double delayOfBase() const { return reaction_.delay(); }

  /// The odometry jumped: what was seen is somewhere else now.
  void forget();

  /// At the plan's last pose within the tolerances.
  bool goalReached(const Pose2& pose, const Pose2& goal) const { return controller_.goalReached(pose, goal); }

 private:
  void lookBack(const MotionSituation& now, double time);
  void planWayOut(const MotionSituation& now, double time);

  MotionController controller_;
  Trail trail_;                     ///< where the robot came
  Trail way_out_;                   ///< back to front: the planned one, while it is driven
  std::optional<Pose2> wedged_at_;  ///< until it has got out; odometry frame
  double planned_at_ = 0.0;         ///< s, when a way out was planned last
  MotionHistory history_;
  Patience patience_;
  MovingSurroundings moving_;
  ReactionWatch reaction_;
  ShortfallWatch shortfall_;
};

}  // namespace lstm_planner
