#pragma once

#include <algorithm>
#include <vector>

#include "drive/motion/wheel_motion.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"

namespace lstm_planner {

/// m/s that the robot may be faster than it measures: encoders count whole ticks.
constexpr double kSpeedError = 0.02;

constexpr double kCreep = 0.005;  ///< m/s; slower is standing
constexpr double kSlack = 1e-9;   ///< m or rad of rounding

/// Share of the safety margin that is kept by a robot with corners that goes back where it was: the margin is at least
/// three times the noise of the scanner.
constexpr double kLeastMargin = 0.5;

/// Share of it that is kept by a robot with corners that has stood for long: the steps of ranges, of a map and of a
/// simulator's cells come on top of noise there.
constexpr double kNarrowMargin = 2.0 / 3.0;

inline double clampMagnitude(double value, double limit) { return std::max(-limit, std::min(limit, value)); }

/// What moves, and what has moved and stands.
struct MotionController::Persons {
  Persons(const Footprint& footprint, double reach, const std::vector<Point2>& moving_points,
          const std::vector<Point2>& resting_points)
      : moving(footprint, 0.0, reach),
        resting(footprint, 0.0, reach),
        near(!moving_points.empty() || !resting_points.empty()) {
    moving.show(moving_points);
    resting.show(resting_points);
  }
  Shield moving;
  Shield resting;
  bool near;  ///< there is somebody
};

/// What a command depends on.
struct MotionController::Moment : MotionSituation {
  const Persons& persons;
  const MotionHistory& history;
  double margin;  ///< m, that a robot with corners keeps
};

/// Which motions of a robot with corners, braking included, come no nearer to a return than `margin` (m). The
/// arguments must outlive it.
class MotionController::SafeMotion {
 public:
  SafeMotion(const MotionController& controller, const MotionSituation& situation, const MotionHistory& history,
             double margin);
  bool operator()(const Twist2& twist);

 private:
  bool isFree(const Pose2& from, const Twist2& twist, double time) const;

  const MotionController& controller_;
  const MotionSituation& situation_;
  double margin_;
  double delay_;    ///< s, for which the robot may go on as it does now
  Pose2 later_;     ///< where it is then, base frame
  bool can_go_on_;  ///< until then
  WheelMotion wheels_;
};

}  // namespace lstm_planner
